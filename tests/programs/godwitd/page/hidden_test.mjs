// A hidden tab keeps control: browsers let its timers run once a minute and draw nothing, and godwit frees control of who
// is silent for ten seconds. Here the page has such timers from its beginning; on the ground, and in flight, where
// nothing may come of it either.
//
//   GODWITD=... GODWIT_SIM=... node --test hidden_test.mjs
//   GODWIT_HIDDEN_S=600 GODWITD=... GODWIT_SIM=... node --test --test-name-pattern="in flight" hidden_test.mjs
//
// GODWIT_HIDDEN_S: so many seconds instead of 14, which are longer than control lasts without a word. The vehicle's time
// is real time.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { flight_world, password, root, until, wait } from "./flight_world.mjs";

const hidden_ms = 1000 * Number(process.env.GODWIT_HIDDEN_S ?? 14);
const longest_flight_s = 3_600;
let world;
before(async () => {
  world = new flight_world({ speed: 1 });
  const mission = JSON.parse(readFileSync(join(root, "missions/survey.json"), "utf8"));
  const gate = mission.items[2].at;
  mission.items.splice(2, 1, { id: "wait", kind: "loiter", at: gate, radius_m: 0, duration_s: longest_flight_s });
  world.mission = join(world.folder, "mission.json");
  writeFileSync(world.mission, JSON.stringify(mission));
  await world.begin();
});
after(() => world.end());

function slow_timers() {
  const minute_ms = 60_000;
  for (const name of ["setTimeout", "setInterval"]) {
    const usual = window[name].bind(window);
    window[name] = (then, time_ms, ...more) => usual(then, Math.max(minute_ms, time_ms ?? 0), ...more);
  }
  window.requestAnimationFrame = () => 0;
  Object.defineProperty(document, "hidden", { get: () => true });
  Object.defineProperty(document, "visibilityState", { get: () => "hidden" });
}

const control = () => world.ctl("status");

// Logged in as anna, who has control.
async function open_hidden_tab() {
  const first = await world.open_browser();
  const context = first.context();
  const logged_in = await first.evaluate(async (said) => (await fetch("/api/v1/session", { method: "POST",
    headers: { "Content-Type": "application/json" }, body: JSON.stringify(said) })).status, { name: "anna", password });
  assert.equal(logged_in, 201);
  const hidden = await context.newPage();
  await hidden.addInitScript(slow_timers);
  await hidden.goto(first.address);
  await hidden.evaluate(() => fetch("/api/v1/control", { method: "POST", headers: { "Content-Type": "application/json" },
    body: JSON.stringify({ act: "take" }) }));
  await first.close();
  assert.match(control(), /anna has control/);
  return hidden;
}

test("control is kept in a hidden tab, and is free ten seconds after the page is closed", async () => {
  const hidden = await open_hidden_tab();
  for (const end = Date.now() + hidden_ms; Date.now() < end; await wait(500)) assert.match(control(), /anna has control/);
  await hidden.close();
  const closed_at = Date.now();
  await until(() => /control is free/.test(control()), "control is free");
  assert.ok(Date.now() - closed_at > 5_000, `${Date.now() - closed_at} ms`);
});

test("in flight, too: control is kept, the flight goes on, and no failsafe takes the tab for a lost link", async () => {
  const hidden = await open_hidden_tab();
  await until(() => /^flight +ready/m.test(control()), "ready", control);
  const verdict = await hidden.evaluate(async () => {
    const { flight } = await (await fetch("/status")).json();
    const answer = await fetch("/api/v1/commands", { method: "POST", headers: { "Content-Type": "application/json" },
      body: JSON.stringify({ id: "anna-start", command: "start", state: flight.state,
        valid_until: `${new Date(Date.now() + 8_000).toISOString().slice(0, 19)}Z` }) });
    return (await answer.json()).verdict;
  });
  assert.equal(verdict, "taken");
  await until(() => /^flight +flying/m.test(control()) && /^failsafe +watches$/m.test(control()), "it flies, guarded", control);
  for (const end = Date.now() + hidden_ms; Date.now() < end; await wait(500)) {
    const now = control();
    for (const part of [/anna has control/, /^flight +flying.*godwit has the vehicle; mission, armed/m, /^failsafe +watches$/m])
      assert.match(now, part);
  }
  await hidden.close();
});
