// The page of operators in a real browser, against a godwitd that flies a simulated vehicle.
//
//   GODWITD=... GODWIT_SIM=... node --test page_test.mjs
//
// One flight from its login to the kill of the daemon; each test begins where the one before has ended.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { flight_world, hold, load, root, soon, until, value_of, wait } from "./flight_world.mjs";
import { take_the_sticks } from "./pilot.mjs";

const markup = "<img src=x onerror=alert(1)>";
let world;
let page;
const text = (where, of = page) => of.textContent(where);
const is_shown = async (where, words, of = page) => ((await of.textContent(where)) ?? "").includes(words);
const shows = (where, words, of = page) => until(() => is_shown(where, words, of), `${words} in ${where}`,
  () => world.daemon.heard.slice(-1_000));

// One grey point as each tile around the vehicle; rows of the file count from the south.
function write_tiles(file) {
  const zoom = 17;
  const count = 2 ** zoom;
  const pixel = "89504e470d0a1a0a0000000d4948445200000001000000010802000000907753de0000000c49444154789c63b871e7120005160287f4e75e960000000049454e44ae426082";
  const column = Math.floor((8.545594 + 180) / 360 * count);
  const latitude = 47.397742 * Math.PI / 180;
  const row = Math.floor((1 - Math.log(Math.tan(latitude) + 1 / Math.cos(latitude)) / Math.PI) / 2 * count);
  const rows = [];
  for (let x = column - 4; x <= column + 4; ++x)
    for (let y = row - 4; y <= row + 4; ++y) rows.push(`(${zoom}, ${x}, ${count - 1 - y}, x'${pixel}')`);
  execFileSync("sqlite3", [file, `CREATE TABLE metadata (name TEXT, value TEXT); CREATE TABLE tiles (zoom_level INTEGER,
    tile_column INTEGER, tile_row INTEGER, tile_data BLOB); INSERT INTO metadata VALUES ('format', 'png'),
    ('attribution', 'grey <tiles> of the tests'); INSERT INTO tiles VALUES ${rows.join(", ")};`]);
}

before(async () => {
  world = new flight_world({ speed: 4 });
  const mission = JSON.parse(readFileSync(join(root, "missions/survey.json"), "utf8"));
  mission.items[2].id = markup;
  world.mission = join(world.folder, "mission.json");
  writeFileSync(world.mission, JSON.stringify(mission));
  const config = join(world.folder, "config.json");
  const tiles = join(world.folder, "map.mbtiles");
  write_tiles(tiles);
  writeFileSync(config, JSON.stringify({ operator: { hosts: "drone.local", tiles }, flight: { drain_percent_per_min: 3 } }));
  world.more = ["--config", config];
  await world.begin();
  page = await world.open_browser({ name: "drone.local" }); // no secure context: no crypto.subtle, no randomUUID
});
after(() => world.end());

test("an operator logs in by name where browsers have no crypto, and sees the vehicle", async () => {
  assert.equal(await page.evaluate("typeof crypto.subtle"), "undefined");
  await shows("#line", "live");
  await world.log_in(page);
  await soon(async () => assert.equal(await text("#me"), "anna operator"));
  await shows("#phase", "ready");
  await soon(async () => assert.match(await text("#authority"), /nobody/));
  await soon(async () => assert.ok(Math.abs(Number(await value_of(page, "Altitude"))) < 2));
  await page.waitForSelector(".mark-vehicle");
  await page.waitForSelector(".mark-home");
});

test("tiles of a file are shown, with their attribution as text", async () => {
  await page.waitForSelector(".leaflet-tile-loaded", { state: "attached" });
  await soon(async () => assert.equal(await text(".leaflet-control-attribution"), "grey <tiles> of the tests"));
});

test("what the checks have found is shown", async () => {
  await page.click("#tab-preflight");
  await shows("#tab-body", "The battery is at");
  await page.click("#tab-plan");
});

test("what the vehicle says is in the log, and stays text", async () => {
  await world.vehicle_does(`say ${markup}`);
  await page.click("#tab-log");
  await shows("#tab-body", `the vehicle reports: ${markup}`);
  assert.equal(await page.locator("#tab-body img").count(), 0);
  await page.click("#tab-plan");
});

test("the mission that is prepared is listed with its revision and where it comes from", async () => {
  await page.click("#tab-missions");
  await shows('#missions [data-place="prepared"]', "file at the start");
  await shows('#missions [data-place="prepared"]', "0 of 9");
  await page.click("#tab-plan");
});

test("what the way home needs of the battery is not known on the ground, and the page says so", async () => {
  await shows('[data-value="Way home"]', "not known");
  await shows('[data-value="Way home"]', "the vehicle is not under way");
});

test("where there is no camera, and nobody looks for points of interest, the page says so", async () => {
  await page.click("#tab-points");
  await shows("#camera-why", "No picture: The camera shows nothing now");
  await shows("#points-summary", "Nobody looks for points of interest now");
  await page.click("#tab-plan");
});

test("a mission is dropped, looked at, shown, refused with the reason where it is none, and handed over", async () => {
  await page.click("#tab-missions");
  await page.setInputFiles("#mission-file", join(root, "tests/data/missions/wrong_types.plan"));
  await page.waitForSelector("#refusal-mission");
  await soon(async () => assert.ok(await page.isDisabled("#hand-over-mission")));
  await page.setInputFiles("#mission-file", { name: "notes.odt", mimeType: "text/plain", buffer: Buffer.from("x") });
  await shows("#refusal-mission", "means no format");
  await page.setInputFiles("#mission-file", join(root, "tests/data/missions/fence.plan"));
  await shows(".upload", "It is drawn on the map.");
  await soon(async () => assert.ok(await page.isDisabled("#hand-over-mission"), "without control"));
  await page.click("#take-control");
  await hold(page, "#hand-over-mission");
  await shows(".upload .taken", "fence.plan was handed over");
  await shows("#missions", "upload");
  await page.click("#tab-plan");
  await until(async () => !(await is_shown("#tab-body", "3b0c5c7e")), "the other mission is the plan");
  await page.click("#tab-missions");
  await page.setInputFiles("#mission-file", world.mission);
  await hold(page, "#hand-over-mission");
  await shows(".upload .taken", "mission.json was handed over");
  await page.click("#tab-plan");
  await shows("#phase", "ready");
  await page.click("#give-control");
  await shows("#control .words", "Control is free.");
});

test("names that look like markup stay text", async () => {
  await shows("#tab-body", markup);
  assert.equal(await page.locator("#tab-body img").count(), 0);
});

test("what moves the vehicle needs control, and is held down to confirm", async () => {
  await soon(async () => assert.ok(await page.isDisabled("#command-start")));
  await page.click("#take-control");
  await shows("#control .words", "You have control.");
  await page.click("#command-start"); // too short
  await wait(300);
  assert.match(await text("#phase"), /ready/);
  await hold(page, "#command-start");
  await shows("#authority strong", "godwit");
  await until(async () => Number(await value_of(page, "Altitude")) > 5, "it climbs");
});

test("in flight the mission is listed as flown, and what the way home needs stands beside the battery", async () => {
  // The drain of the battery is known a while behind the take-off.
  const told = /needs \d+\s*%\s*\d+ % to spare above \d+ %|how fast the battery drains is not known yet/;
  await until(async () => told.test(await text('[data-value="Way home"]')), "what the way home needs", () => world.daemon.heard.slice(-1_500));
  await page.click("#tab-missions");
  await shows('#missions [data-place="in_flight"]', "flown now");
  await page.click("#tab-plan");
});

test("a refusal stands beside its button with its reason", async () => {
  await hold(page, "#command-start");
  await page.waitForSelector("#refusal-start");
  await soon(async () => assert.ok((await text("#refusal-start")).length > 10));
});

test("a second operator sees who has control, can stop and can not start; an engineer takes it over, and overrides a rule of the failsafe", async () => {
  const other = await world.open_browser();
  await world.log_in(other, "bob");
  await shows("#control .words", "anna has control.", other);
  await soon(async () => assert.ok(await other.isDisabled("#command-start")));
  await other.click("#command-pause");
  await shows("#phase", "paused", other);
  await shows("#phase", "paused");
  await other.click("#take-over");
  await shows("#control .words", "You have control.", other);
  await shows("#control .words", "bob has control.");
  await shows("#alarms", "You no longer have control: bob has it.");
  await other.click("#tab-failsafe");
  await shows('[data-rule="operator_link"]', "watches", other);
  await soon(async () => assert.ok(await other.isDisabled("#command-override"), "without a reason"));
  await other.fill("#override-reason", "we walk <b>over</b> the hill");
  await hold(other, "#command-override");
  await shows('[data-rule="operator_link"]', "we walk <b>over</b> the hill", other);
  await soon(async () => assert.match(await text('[data-rule="operator_link"]', other), /overridden until \d\d:\d\d:\d\d UTC/));
  await other.click("#give-control");
  await shows("#control .words", "Control is free.");
  await page.click("#take-control");
  await shows("#control .words", "You have control.");
  await other.context().close();
  await page.click("#tab-failsafe");
  await shows("#override-why-not", "An engineer overrides a rule of the failsafe.");
});

test("by keyboard alone: the flight goes on", async () => {
  await page.evaluate("document.activeElement.blur()");
  await page.keyboard.press("r");
  await soon(async () => assert.equal(await page.evaluate("document.activeElement.id"), "command-resume"));
  await hold(page, "#command-resume", () => page.keyboard.down(" "), () => page.keyboard.up(" "));
  await shows("#phase strong", "flying");
});

test("a go-to shows its way before it is confirmed", async () => {
  await page.keyboard.press("g");
  await shows(".going", "Click the place");
  const box = await page.locator("#map").boundingBox();
  await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
  await shows(".going", "from the vehicle");
  await soon(async () => assert.ok(await page.isEnabled("#confirm-go_to")));
  await page.keyboard.press("Escape");
  await until(async () => (await page.locator(".going").count()) === 0, "it is left");
});

test("a waypoint is inserted at a click on the map", async () => {
  await page.keyboard.press("i");
  const box = await page.locator("#map").boundingBox();
  await page.mouse.click(box.x + box.width / 2, box.y + box.height / 3);
  await shows(".going", "from the vehicle");
  await hold(page, "#confirm-insert");
  await until(async () => (await page.locator(".going").count()) === 0 || (await page.locator("#refusal-insert").count()) === 1, "an answer");
  await page.keyboard.press("Escape");
  await page.click("#tab-audit");
  await shows("#tab-body", "insert");
  await page.click("#tab-plan");
});

test("a pilot who takes the vehicle is shown large, and the alarm stays until it is seen", async () => {
  await take_the_sticks(world.vehicle_port);
  await shows("#authority strong", "a person");
  await shows("#alarms", "A person has taken the vehicle");
  await hold(page, "#command-hand_back");
  await shows("#authority strong", "godwit");
  await shows("#alarms", "A person has taken the vehicle");
  await until(async () => {
    if ((await page.locator("#alarms p").count()) === 0) return true;
    await page.evaluate("document.querySelector('#alarms button')?.click()");
    return false;
  }, "what was seen is gone");
});

test("the flight goes on when it is said so, and refusals of before are gone", async () => {
  await hold(page, "#command-resume");
  await shows("#phase strong", "flying");
  await until(async () => (await page.locator(".refusal").count()) === 0, "no refusal is left");
});

test("an actor that crashes is red with its reason, and has the next incarnation", async () => {
  await page.click("#tab-actors");
  await shows('[data-actor="mapobjects_store"]', "incarnation 1");
  world.ctl("crash", "mapobjects_store");
  await shows('[data-actor="mapobjects_store"]', "incarnation 2");
  await soon(async () => assert.match(await text('[data-actor="mapobjects_store"]'), /last crash: /));
  await soon(async () => assert.match(await page.getAttribute('[data-actor="mapobjects_store"]', "class"), /warn|bad/));
});

test("log and audit can be filtered", async () => {
  await page.click("#tab-log");
  await shows("#tab-body", "executor");
  await page.fill("#filter", "no line has this");
  await until(async () => (await page.locator("#tab-body tr").count()) === 0, "no line");
  await page.click("#tab-audit");
  await shows("#tab-body", "hand_back");
  await shows("#tab-body", "we walk <b>over</b> the hill");
  assert.equal(await page.locator("#tab-body b").count(), 0, "a reason stays text");
});

test("axe finds nothing serious, by day, in sunlight and at night", async () => {
  const { AxeBuilder } = load("@axe-core/playwright");
  for (const theme of ["day", "sun", "night"]) {
    await page.click(`#theme-${theme}`);
    const look = new AxeBuilder({ page });
    const { violations } = await (theme === "day" ? look : look.withRules(["color-contrast"])).analyze();
    const serious = violations.filter((each) => each.impact === "serious" || each.impact === "critical");
    assert.deepEqual(serious.map((each) => `${theme} ${each.id}: ${each.nodes.map((node) => node.html.slice(0, 200)).join("; ")}`), []);
  }
});

test("the plots are drawn at the size of a laptop and of a tablet", async () => {
  await page.click("#theme-day");
  await page.click("#tab-plots");
  for (const size of [{ width: 1280, height: 800 }, { width: 820, height: 1180 }]) {
    await page.setViewportSize(size);
    await page.waitForSelector("#plots canvas");
    await soon(async () => {
      const { width } = await page.locator("#plots canvas").first().boundingBox();
      assert.ok(width > 200 && width <= size.width, `${width} of ${size.width} pixels`);
    });
  }
});

test("on a phone who has the vehicle, Pause and Come home stay in view, however far one scrolls", async () => {
  const size = { width: 390, height: 844 };
  await page.setViewportSize(size);
  for (const top of [0, 700, 100_000]) {
    await page.evaluate((to) => window.scrollTo(0, to), top);
    for (const where of ["#authority", "#command-pause", "#command-come_home"])
      await soon(async () => {
        const box = await page.locator(where).boundingBox();
        assert.ok(box.x >= 0 && box.y >= 0 && box.x + box.width <= size.width && box.y + box.height <= size.height, `${where}, ${top} down`);
        const is_on_top = await page.evaluate(([what, x, y]) => document.elementFromPoint(x, y)?.closest(what) !== null,
          [where, box.x + box.width / 2, box.y + box.height / 2]);
        assert.ok(is_on_top, `${where} is covered, ${top} down`);
      });
  }
  assert.equal(await page.evaluate("document.documentElement.scrollWidth"), size.width);
  await page.evaluate(() => window.scrollTo(0, 0));
  await page.setViewportSize({ width: 1280, height: 800 });
});

// How soon is a figure of `./dev bench page`.
test("a page shows that godwitd was killed, and after its start all is as on a fresh page", async () => {
  await world.daemon.kill();
  await shows("#line", "not heard");
  await until(() => page.locator(".instrument.old .age").count(), "old values say their age");
  await world.start_daemon();
  await shows("#line", "live");
  await until(async () => (await page.locator(".instrument.old").count()) === 0, "all values are new again");
  const fresh = await world.open_browser({ name: "drone.local" });
  await shows("#line", "live", fresh);
  for (const part of ["#authority strong", "#phase strong", "#progress"])
    await until(async () => (await text(part)) === (await text(part, fresh)), `${part} is the same on both`);
  await shows("#control .words", "You have control."); // its holder has ten seconds behind a restart
});

test("nothing is asked of another host, and the browser has nothing to complain about", () => {
  assert.deepEqual(page.asked_elsewhere, []);
  assert.deepEqual(page.said.filter((each) => !/status of (4(01|04|09|12|22|23)|503)|ERR_CONNECTION|Cross-Origin-Opener-Policy/.test(each)), []);
});
