// A hidden tab keeps control: browsers let its timers run once a minute and draw nothing, and godwit frees control of who
// is silent for ten seconds. Here the page has such timers from its beginning.
//
//   GODWITD=... GODWIT_SIM=... node --test hidden_test.mjs
//
// GODWIT_HIDDEN_S: so many seconds instead of 14, which are longer than control lasts without a word.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { flight_world, password, until, wait } from "./flight_world.mjs";

const hidden_ms = 1000 * Number(process.env.GODWIT_HIDDEN_S ?? 14);
let world;
before(async () => {
  world = await new flight_world().begin();
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

test("control is kept in a hidden tab, and is free ten seconds after the page is closed", async () => {
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
  for (const end = Date.now() + hidden_ms; Date.now() < end; await wait(500)) assert.match(control(), /anna has control/);
  await hidden.close();
  const closed_at = Date.now();
  await until(() => /control is free/.test(control()), "control is free");
  assert.ok(Date.now() - closed_at > 7_000, `${Date.now() - closed_at} ms`);
});
