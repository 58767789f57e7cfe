import assert from "node:assert/strict";
import { test } from "node:test";
import type { heard_aircraft, known_mission, way_home_update } from "../../../../../programs/godwitd/page/src/model/messages.ts";
import { aircraft_words, left_out_words, mission_words, object_words, origin_words, traffic_words, way_home_words } from "../../../../../programs/godwitd/page/src/model/words.ts";

const known: way_home_update = { needs_percent: 22.1, left_percent: 60, reserve_percent: 25, spare_percent: 12.9, why_not_known: "" };

test("what the way home needs is rounded up, and what is to spare is rounded down", () => {
  assert.deepEqual(way_home_words(known), { value: "needs 23", unit: "%", more: "12 % to spare above 25 %", is_short: false });
});

test("a battery that lasts just for the way home is said so", () => {
  const words = way_home_words({ ...known, spare_percent: 0 });
  assert.equal(words.is_short, true);
  assert.equal(words.more, "the battery lasts just for it, above 25 %");
});

test("what is not known is said as such, with the reason", () => {
  const words = way_home_words({ ...known, needs_percent: null, spare_percent: null, why_not_known: "how fast the battery drains is not known yet" });
  assert.deepEqual(words, { value: "not known", unit: "", more: "how fast the battery drains is not known yet", is_short: false });
  assert.equal(way_home_words(undefined).value, "–");
});

test("an object is named with its class and when it was seen", () => {
  const object = { class_group: "small_boat", latitude_deg: 47, longitude_deg: 8, confidence: 0.9, last_seen_ms: 1_795_459_713_049, is_seen_here: true };
  assert.equal(object_words(object), "small boat, 90 %, seen 2026-11-23 18:48:33 UTC");
  assert.match(object_words({ ...object, is_seen_here: false }), /of the map that was pulled$/);
});

test("objects that are not drawn are counted and said, and nothing is said when all are drawn", () => {
  const objects = Array(500).fill({});
  assert.equal(left_out_words(undefined), "");
  assert.equal(left_out_words({ objects, counted: 500, is_all: true }), "");
  assert.equal(left_out_words({ objects, counted: 1_234, is_all: true }), "500 of 1,234 objects are drawn, the newest; zoom in for the rest");
  assert.match(left_out_words({ objects, counted: 10_000, is_all: false }), /^500 of more than 10,000 objects/);
});

test("a mission that has ended is called by its outcome, and one that can not start yet is no good one", () => {
  const mission: known_mission = { mission_id: "m", revision: 1, origin: "service", place: "ended", outcome: "aborted",
    last_report_at: "", items: null, items_done: null, reason: "" };
  assert.deepEqual(mission_words(mission), { words: "aborted", tone: "warn" });
  assert.equal(mission_words({ ...mission, outcome: "complete" }).tone, "good");
  assert.equal(mission_words({ ...mission, place: "prepared", reason: "preflight: charge it" }).tone, "warn");
  assert.equal(mission_words({ ...mission, place: "of_a_newer_godwitd" }).words, "of a newer godwitd");
  assert.equal(origin_words("station"), "ground station");
});

const aircraft: heard_aircraft = { icao: 1, name: "SWR123", latitude_deg: 47, longitude_deg: 8, age_s: 2.4, course_deg: 90, height_m: 60, is_close: false,
  sentence: "SWR123, 9 km to the north" };

test("an aircraft on the map has its name, its height above the vehicle and its age", () => {
  assert.equal(aircraft_words(aircraft), "SWR123 +60 m, 2 s");
  assert.equal(aircraft_words({ ...aircraft, height_m: -1_250 }), "SWR123 −1.25 km, 2 s");
  assert.equal(aircraft_words({ ...aircraft, height_m: null }), "SWR123 height not known, 2 s");
});

test("of all aircraft the nearest is named, and it is wrong when any is close or the autopilot warns", () => {
  assert.deepEqual(traffic_words(undefined), { value: "none heard", more: "", is_close: false });
  assert.deepEqual(traffic_words({ aircraft: [aircraft, aircraft], warnings: [] }), { value: "2 heard", more: aircraft.sentence, is_close: false });
  assert.deepEqual(traffic_words({ aircraft: [aircraft, { ...aircraft, is_close: true, sentence: "HB-ABC" }], warnings: [] }), { value: "close", more: "HB-ABC", is_close: true });
  assert.deepEqual(traffic_words({ aircraft: [], warnings: ["it warns"] }), { value: "none heard", more: "it warns", is_close: true });
});
