import assert from "node:assert/strict";
import { test } from "node:test";
import { alarms } from "../../../../../programs/godwitd/page/src/model/alarms.ts";
import type { text, topic, topics } from "../../../../../programs/godwitd/page/src/model/messages.ts";
import { world } from "../../../../../programs/godwitd/page/src/model/world.ts";

let number = 0;
function said<T extends topic>(which: T, data: topics[T]): text {
  return { topic: which, number: ++number, at_ms: 1_000_000, data } as text;
}

function opened(): world {
  const all = new world();
  all.is_open = true;
  all.take({ topic: "stream", data: { session: "1" } }, 0);
  all.take(said("clock", { beat: 1 }), 0);
  return all;
}

const point = (n: number) => ({ number: n, class_group: "person", latitude_deg: 47, longitude_deg: 8, confidence: 0.9, has_moved: false,
  decide_until_ms: 1_060_000, by: "" });
const points = (...numbers: number[]) => said("points", { is_looking: true, mission_id: "m", shown: numbers.map(point), confirmed: [], waiting: 0 });

test("each point of interest sounds once, all of them are one alarm, and it goes when nobody can decide any more", () => {
  const all = opened();
  const heard = new alarms();
  all.take(points(4), 0);
  assert.equal(heard.look(all, 0), true);
  assert.equal(heard.look(all, 0), false);
  all.take(points(4, 5), 0);
  assert.equal(heard.look(all, 0), true);
  assert.deepEqual(heard.list.map((each) => each.words), ["Points of interest wait for a decision: 4 (person), 5 (person)."]);
  all.take(points(5), 0);
  assert.equal(heard.look(all, 0), false);
  assert.deepEqual(heard.list.map((each) => each.words), ["Point of interest 5 (person) waits for a decision."]);
  all.take(points(), 0);
  heard.look(all, 0);
  assert.deepEqual(heard.list, []);
});

test("a point that was seen does not sound again while another one comes and goes", () => {
  const all = opened();
  const heard = new alarms();
  all.take(points(4), 0);
  heard.look(all, 0);
  heard.see("points");
  assert.equal(heard.look(all, 0), false);
  assert.deepEqual(heard.list, []);
  all.take(points(4, 5), 0);
  assert.equal(heard.look(all, 0), true);
});
