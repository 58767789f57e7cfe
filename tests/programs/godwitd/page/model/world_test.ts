import assert from "node:assert/strict";
import { test } from "node:test";
import type { text, topic, topics } from "../../../../../programs/godwitd/page/src/model/messages.ts";
import { world } from "../../../../../programs/godwitd/page/src/model/world.ts";

let number = 0;
function said<T extends topic>(which: T, at_ms: number, data: topics[T]): text {
  return { topic: which, number: ++number, at_ms, data } as text;
}
const position = { latitude_deg: 47, longitude_deg: 8, altitude_m: 1, altitude_msl_m: 400, ground_speed_mps: 0,
  climb_mps: 0, heading_deg: null };

function opened(now: number): world {
  const all = new world();
  all.is_open = true;
  all.take({ topic: "stream", data: { session: "1" } }, now);
  all.take(said("clock", 1_000_000, { beat: 1 }), now);
  return all;
}

test("a value is as old as the clock of godwitd says, also one that was said before the page was opened", () => {
  const all = opened(5_000);
  all.take(said("position", 999_000, position), 5_000);
  assert.equal(all.age_ms("position", 5_000), 1_000);
  assert.equal(all.is_old("position", 5_900), false);
  assert.equal(all.is_old("position", 6_100), true);
  assert.equal(all.age_ms("battery", 6_100), Infinity);
});

test("what holds until it changes is old when godwitd is not heard, and not before", () => {
  const all = opened(0);
  all.take(said("authority", 500_000, { holder: "godwit" }), 0);
  assert.equal(all.is_old("authority", 1_000), false);
  assert.equal(all.is_old("authority", 2_100), true);
});

test("silence is said within two seconds, and at once when the line is closed", () => {
  const all = opened(0);
  assert.equal(all.is_heard(1_700), true);
  assert.equal(all.is_heard(1_900), false);
  all.is_open = false;
  assert.equal(all.is_heard(10), false);
});

test("another process is another world: what the one before has said is forgotten", () => {
  const all = opened(0);
  all.take(said("position", 1_000_000, position), 1);
  all.take(said("log", 1_000_000, { is_warning: false, part: "executor", sentence: "before" }), 1);
  assert.equal(all.take({ topic: "stream", data: { session: "1" } }, 2), false);
  assert.ok(all.get("position"));
  assert.equal(all.take({ topic: "stream", data: { session: "2" } }, 3), true);
  assert.equal(all.get("position"), undefined);
  assert.deepEqual(all.log, []);
});

test("lines of the log are kept once and in their order, however they came", () => {
  const all = opened(0);
  const line = (n: number) => ({ number: n, at_ms: n, is_warning: false, part: "a", sentence: String(n) });
  all.add_log([line(12), line(13)]);
  all.add_log([line(11), line(12)]);
  assert.deepEqual(all.log.map((each) => each.number), [11, 12, 13]);
});

test("a topic of a newer godwitd is no harm", () => {
  const all = opened(0);
  all.take({ topic: "weather", number: 1, at_ms: 1, data: {} } as unknown as text, 1);
  assert.equal(all.is_heard(1), true);
});
