// The page of operators in Debian's Firefox: what page_test.mjs shows in Chromium, along one short flight. Each test
// begins where the one before has ended.
//
//   GODWITD=... GODWIT_SIM=... node --test firefox_test.mjs
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { flight_world, hold, soon, until, value_of } from "./flight_world.mjs";
import { take_the_sticks } from "./pilot.mjs";

const patience_ms = 60_000; // it starts slowly, and beside other tests
let world;
let page;
const shows = (where, words) => until(async () => (await page.textContent(where)).includes(words), `${words} in ${where}`,
  () => world.daemon.heard.slice(-1_000), patience_ms);
const is_disabled = (where) => page.$eval(where, (found) => found.disabled);

before(async () => {
  world = new flight_world({ speed: 4 });
  await world.begin();
  page = await world.open_firefox();
  assert.match(await page.evaluate("navigator.userAgent"), /Firefox/);
});
after(() => world.end());

test("an operator logs in and sees the vehicle, its place on the map and its values", async () => {
  await shows("#line", "live");
  await world.log_in(page);
  await shows("#me", "anna operator");
  await shows("#phase", "ready");
  await soon(async () => assert.ok(Math.abs(Number(await value_of(page, "Altitude"))) < 2), patience_ms);
  for (const mark of [".mark-vehicle", ".mark-home"]) await page.waitForSelector(mark);
});

test("what moves the vehicle needs control, and is held down to confirm", async () => {
  await soon(async () => assert.ok(await is_disabled("#command-start")));
  await page.click("#take-control");
  await shows("#control .words", "You have control.");
  await page.click("#command-start"); // too short
  await shows("#phase", "ready");
  await hold(page, "#command-start");
  await shows("#authority strong", "godwit");
  await until(async () => Number(await value_of(page, "Altitude")) > 5, "it climbs", () => "", patience_ms);
});

test("it is paused with a click and resumed by keyboard alone", async () => {
  await page.click("#command-pause");
  await shows("#phase", "paused");
  await page.evaluate("document.activeElement.blur()");
  await page.keyboard.press("r");
  await soon(async () => assert.equal(await page.evaluate("document.activeElement.id"), "command-resume"));
  await hold(page, "#command-resume", () => page.keyboard.down(" "), () => page.keyboard.up(" "));
  await shows("#phase strong", "flying");
});

test("a pilot who takes the vehicle is shown large, with an alarm", async () => {
  await take_the_sticks(world.vehicle_port);
  await shows("#authority strong", "a person");
  await shows("#alarms", "A person has taken the vehicle");
});

test("on a phone who has the vehicle, Pause and Come home stay in view, however far one scrolls", async () => {
  const size = { width: 390, height: 844 };
  await page.setViewport(size);
  for (const top of [0, 700, 100_000]) {
    await page.evaluate((to) => window.scrollTo(0, to), top);
    for (const where of ["#authority", "#command-pause", "#command-come_home"])
      await soon(async () => {
        const box = await (await page.$(where)).evaluate((found) => found.getBoundingClientRect().toJSON());
        assert.ok(box.left >= 0 && box.top >= 0 && box.right <= size.width && box.bottom <= size.height, `${where}, ${top} down`);
      });
  }
});

test("a page shows that godwitd was killed, and that it is back", async () => {
  await world.daemon.kill();
  await shows("#line", "not heard");
  await world.start_daemon();
  await shows("#line", "live");
  await shows("#authority strong", "a person");
});

test("nothing is asked of another host, and the browser has nothing to complain about", () => {
  assert.deepEqual(page.asked_elsewhere, []);
  assert.deepEqual(page.said.filter((each) => !/can.t establish a connection to the server at ws:/.test(each)), []); // while it was killed
});
