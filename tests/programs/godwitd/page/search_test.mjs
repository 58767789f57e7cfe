// A search in a real browser: the live picture, points of interest, and a flight to one of them. A simulated vehicle
// with a camera, godwit-eyes, a missions service (what is found counts when its map was pulled), sightings from a file.
//
//   GODWITD=... GODWIT_SIM=... node --test search_test.mjs
//
// With GODWIT_PICTURES=FOLDER the picture that README shows is written there.
import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { flight_world, free_port, hold, root, soon, until, wait } from "./flight_world.mjs";

// Markup in a name must stay text; the picture for README shows names as people give them.
const names = ["person", "vehicle", process.env.GODWIT_PICTURES ? "boat" : "<b>boat</b>"];
let world;
let page;
before(async () => {
  const uri = `rtsp://127.0.0.1:${await free_port()}/camera`;
  world = new flight_world({ speed: 3, mission: join(root, "missions/search.json"), has_service: true,
    vehicle_more: ["--camera", `${uri}?width=320&height=180&fps=5&movers=0`] });
  const config = join(world.folder, "config.json");
  writeFileSync(config, JSON.stringify({ camera: { uri, width_px: 320, height_px: 180, focal_px: 277, mount_pitch_deg: -90 } }));
  const seen = join(world.folder, "seen.ndjson");
  const line = (class_group, index) => JSON.stringify({ id: `00000000-0000-4000-8000-00000000000${index}`, class_group,
    latitude: 47.3983, longitude: 8.5448 + 0.001 * index, confidence: 0.9, at: `${new Date().toISOString().slice(0, 19)}Z` });
  writeFileSync(seen, `${names.map(line).join("\n")}\n`);
  world.more = ["--config", config, "--sightings", seen];
  await world.begin();
  page = await world.open_browser();
  await world.log_in(page);
});
after(() => world.end());

const shows = (where, words) => until(async () => ((await page.textContent(where)) ?? "").includes(words), `${words} in ${where}`,
  () => world.daemon.heard.slice(-1_500));
const age_s = async () => Number(/picture ([\d.]+) s old/.exec(await page.textContent("#camera-age"))?.[1] ?? NaN);
// How many different colours the picture has: nothing has one.
const colours = () => page.evaluate(() => {
  const canvas = document.getElementById("camera");
  const bytes = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
  return new Set(new Uint32Array(bytes.buffer)).size;
});

test("on the ground there is no picture, and the page says so", async () => {
  await page.click("#tab-points");
  await page.waitForSelector("#camera-why");
  assert.ok(Number.isNaN(await age_s()));
});

test("points of interest sound, stand on the map, and one is confirmed, one declined; their names stay text", async () => {
  await shows("#phase", "ready");
  await page.click("#take-control");
  await hold(page, "#command-start");
  await shows("#alarms", "for a decision");
  for (const name of names) await page.waitForSelector(`tr.open:has-text("${name}")`);
  await soon(async () => assert.ok(await page.locator(".mark-point.shown").count() >= names.length));
  assert.equal(await page.locator("#tab-body table b", { hasText: "boat" }).count(), 0);
  const number_of = (name) => page.locator("tr.open", { hasText: name }).getAttribute("data-point");
  const [person, boat] = [await number_of("person"), await number_of("boat")];
  if (process.env.GODWIT_PICTURES) {
    await until(async () => (await age_s()) < 1, "a picture");
    await page.click("#see-all");
    await wait(300);
    writeFileSync(join(process.env.GODWIT_PICTURES, "page_search.png"), await page.screenshot());
  }
  await page.click("#see-all");
  await wait(300);
  await page.click(`#decline-${boat}`);
  await page.click(`#confirm-${person}`);
  await shows(`[data-point="${person}"]`, "confirmed by anna");
  await until(async () => (await page.locator("tr.open", { hasText: "boat" }).count()) === 0, "what is declined is gone");
  await soon(async () => assert.equal(await page.locator(".mark-point.confirmed").count(), 1));
});

test("in flight the newest picture is shown with its age", async () => {
  await until(async () => (await age_s()) < 2, "a new picture", () => world.daemon.heard.slice(-1_500));
  await soon(async () => assert.ok((await colours()) > 50));
  assert.equal(await page.evaluate("document.getElementById('camera').width"), 320);
});

test("the page can ask for the objects of the map, and none is left out", async () => {
  const { objects, counted, is_all } = await page.evaluate(async () => (await fetch("/api/v1/map/objects")).json());
  assert.deepEqual(objects.map((each) => each.class_group).sort(), [...names].sort());
  assert.equal(counted, names.length);
  assert.equal(is_all, true);
  assert.equal(await page.locator("#objects-left-out").count(), 0);
});

test("no picture is asked for of a point that the camera has not shown", () => {
  assert.deepEqual(page.said.filter((each) => /404/.test(each)), []);
});

test("a confirmed point is flown to by a second word, which shows the way and is held down", async () => {
  await page.click("[id^=visit-]");
  await shows(".going", "from the vehicle");
  await shows("#insert-then", "Then on with");
  const before = await page.textContent("#progress");
  await hold(page, "#confirm-insert");
  await until(async () => (await page.textContent("#progress")) !== before, "the mission has one item more", () => world.daemon.heard.slice(-1_500));
  assert.equal(await page.locator("#refusal-insert").count(), 0);
  await page.click("#tab-plan");
  await shows("#tab-body", "extra");
  await page.click("#tab-points");
});

test("a camera that falls silent is said: its picture looks old, and then there is none", async () => {
  await until(async () => (await age_s()) < 2, "a new picture");
  await world.vehicle_does("camera cut");
  await page.waitForSelector(".camera.old .age");
  assert.ok((await age_s()) > 1.9);
  await page.waitForSelector("#camera-why");
  await world.vehicle_does("camera back");
  await until(async () => (await age_s()) < 2, "it is back");
});
