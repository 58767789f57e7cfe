import assert from "node:assert/strict";
import { test } from "node:test";
import type { known_mission, way_home_update } from "../../../../../programs/godwitd/page/src/model/messages.ts";
import { mission_words, origin_words, way_home_words } from "../../../../../programs/godwitd/page/src/model/words.ts";

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

test("a mission that has ended is called by its outcome, and one that can not start yet is no good one", () => {
  const mission: known_mission = { mission_id: "m", revision: 1, origin: "service", place: "ended", outcome: "aborted",
    last_report_at: "", items: null, items_done: null, reason: "" };
  assert.deepEqual(mission_words(mission), { words: "aborted", tone: "warn" });
  assert.equal(mission_words({ ...mission, outcome: "complete" }).tone, "good");
  assert.equal(mission_words({ ...mission, place: "prepared", reason: "preflight: charge it" }).tone, "warn");
  assert.equal(mission_words({ ...mission, place: "of_a_newer_godwitd" }).words, "of a newer godwitd");
  assert.equal(origin_words("station"), "ground station");
});
