import assert from "node:assert/strict";
import { test } from "node:test";
import { alarms } from "../../../../../programs/godwitd/page/src/model/alarms.ts";
import { crashes } from "../../../../../programs/godwitd/page/src/model/crashes.ts";
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

const point = (n: number) => ({ number: n, class_group: "person", latitude_deg: 47, longitude_deg: 8, confidence: 0.9, has_moved: false, has_picture: false,
  decide_until_ms: 1_060_000, by: "" });
const points = (...numbers: number[]) => said("points", { is_looking: true, mission_id: "m", shown: numbers.map(point), confirmed: [], waiting: 0 });

test("what holds for a moment at each start is an alarm when it lasts, and not before", () => {
  const all = opened();
  const heard = new alarms();
  const red = (health: string) => all.take(said("health", { worst: health, since_ms: 0, parts: [{ part: "vehicle_link", health, reason: "no heartbeat", since_ms: 0 }] }), 0);
  red("red");
  assert.equal(heard.look(all, 0), false);
  red("green");
  assert.equal(heard.look(all, 1_000), false);
  red("red");
  assert.equal(heard.look(all, 1_500), false);
  all.heard_at = 3_500;
  assert.equal(heard.look(all, 3_500), true);
  assert.equal(heard.look(all, 3_600), false);
  assert.deepEqual(heard.list.map((each) => each.words), ["vehicle_link: no heartbeat"]);
});

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

test("an actor that crashed is away with its reason until it is back or given up", () => {
  const heard = new crashes();
  const line = (sentence: string, part = "executor") => heard.hear({ is_warning: false, part, sentence }, 1_000);
  line("sightings crashed: killed");
  line("health crashed");
  line("failsafe crashed: not by the executor", "statustext");
  assert.deepEqual(["sightings", "health", "failsafe"].map((each) => heard.reason_of(each, 1_100)), ["killed", "", undefined]);
  line("sightings is back");
  line("health is given up: it crashed too often");
  assert.deepEqual(["sightings", "health"].map((each) => heard.reason_of(each, 1_100)), [undefined, undefined]);
  line("health crashed: it was stopped then, and nobody says that it is back");
  assert.equal(heard.reason_of("health", 7_000), undefined);
});

test("another aircraft is an alarm when the executor tells of it, and not when it has passed", () => {
  const heard = new alarms();
  const said_in_log = (sentence: string, is_warning: boolean, part = "executor") => heard.hear({ part, is_warning, sentence }, 1);
  assert.equal(said_in_log("aircraft close: SWR123, 800 m to the north", true), true);
  assert.equal(said_in_log("the autopilot warns of a collision with SWR123, and hovers", true), true);
  assert.equal(said_in_log("other aircraft near the way there: SWR123", true), true);
  assert.equal(said_in_log("aircraft SWR123 is close no more, as far as it is heard", false), false);
  assert.equal(said_in_log("aircraft close: SWR123", true, "ground_port"), false);
  assert.deepEqual(heard.list.map((each) => each.words)[0], "aircraft close: SWR123, 800 m to the north");
  assert.equal(heard.list.length, 3);
});
