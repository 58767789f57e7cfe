import assert from "node:assert/strict";
import { test } from "node:test";
import { deviation_m, moved, offset_of, bearing_deg, distance_m, item_after, round_step_m, way_of, way_of_insert } from "../../../../../programs/godwitd/page/src/model/geometry.ts";
import { flight_history, max_samples } from "../../../../../programs/godwitd/page/src/model/history.ts";
import type { place, plan_view } from "../../../../../programs/godwitd/page/src/model/messages.ts";
import { max_points, track } from "../../../../../programs/godwitd/page/src/model/track.ts";

const zero: place = { latitude: 47.4, longitude: 8.5 };
const at = (east_m: number, north_m: number) => moved(zero, { east_m, north_m });

test("a straight line of any length is few points, and its end is where the vehicle is", () => {
  const way = new track();
  for (let i = 0; i <= 10_000; ++i) way.add(at(i * 0.5, 0));
  assert.ok(way.kept.length <= 10_000 / 60 + 2, String(way.kept.length));
  assert.ok(distance_m(way.last as place, at(5_000, 0)) < 0.1);
});

test("no place of the way is further from what is kept than the width of a bend", () => {
  const way = new track(0.7);
  const flown: place[] = [];
  for (let i = 0; i < 2_000; ++i) {
    const each = at(60 * Math.cos(i / 40), 60 * Math.sin(i / 25));
    flown.push(each);
    way.add(each);
  }
  const shown = [...way.kept, way.last as place];
  for (const each of flown) {
    let nearest = Infinity;
    for (let i = 1; i < shown.length; ++i) nearest = Math.min(nearest, deviation_m(each, shown[i - 1] as place, shown[i] as place));
    assert.ok(nearest < 1.5, `${nearest} m`);
  }
});

test("two hours at ten a second stay within the bound", () => {
  const way = new track();
  for (let i = 0; i < 72_000; ++i) way.add(at(i * 0.5, 30 * Math.sin(i / 9)));
  assert.ok(way.kept.length <= max_points, String(way.kept.length));
  assert.ok(way.kept.length > max_points / 8, String(way.kept.length));
});

test("a vehicle that stands adds nothing", () => {
  const way = new track();
  for (let i = 0; i < 1_000; ++i) way.add(at(0.05 * (i % 2), 0));
  assert.equal(way.kept.length, 1);
});

test("two hours of samples stay within the bound, in order, and a clock that is set back begins anew", () => {
  const all = new flight_history();
  for (let i = 0; i < 72_000; ++i) all.add({ at_ms: i * 100, altitude_m: i, speed_mps: 1, battery_percent: null });
  assert.ok(all.samples.length <= max_samples && all.samples.length > max_samples / 3, String(all.samples.length));
  const [at_s] = all.columns();
  for (let i = 1; i < at_s.length; ++i) assert.ok((at_s[i] as number) > (at_s[i - 1] as number));
  all.add({ at_ms: 5, altitude_m: 0, speed_mps: 0, battery_percent: 50 });
  assert.equal(all.samples.length, 1);
});

test("offsets lead there and back, and bearings are clockwise from north", () => {
  const there = at(300, -400);
  const by = offset_of(zero, there);
  assert.ok(Math.abs(by.east_m - 300) < 1e-6 && Math.abs(by.north_m + 400) < 1e-6);
  assert.ok(Math.abs(distance_m(zero, there) - 500) < 1e-6);
  assert.ok(Math.abs(bearing_deg(zero, at(10, 0)) - 90) < 1e-6);
  assert.ok(Math.abs(bearing_deg(zero, at(0, -10)) - 180) < 1e-6);
});

test("steps of the grid are 1, 2 or 5 times a power of ten", () => {
  for (const [metres, step] of [[0.7, 1], [1.1, 2], [3, 5], [7, 10], [50, 50], [51, 100], [900, 1000]] as const)
    assert.equal(round_step_m(metres), step);
});

test("the way is that of the vehicle's plan, and else that of the mission's places", () => {
  const mission = { mission_id: "m", revision: 1, geofences: [], return_point: { ...zero, altitude_m: 0 }, items: [
    { id: "t", kind: "takeoff", altitude_m: 10 }, { id: "w", kind: "waypoint", at: { ...at(10, 0), altitude_m: 10 } },
    { id: "s", kind: "survey", polygon: [at(0, 0), at(20, 0), at(20, 20), at(0, 20)] }] };
  const view: plan_view = { mission, generation: 0, way: [], home: null, kept: null };
  const way = way_of(view);
  assert.equal(way.length, 2);
  assert.ok(distance_m(way[1] as place, at(10, 10)) < 0.01);
  assert.equal(way_of({ ...view, way: [{ ...zero, altitude_m: 1 }] }).length, 1);
});

test("a waypoint that is inserted leads on to the item behind it that has a place", () => {
  const mission = { mission_id: "m", revision: 1, geofences: [], return_point: { ...zero, altitude_m: 0 }, items: [
    { id: "a", kind: "waypoint", at: { ...at(10, 0), altitude_m: 10 } }, { id: "speed", kind: "change_speed" },
    { id: "b", kind: "waypoint", at: { ...at(20, 0), altitude_m: 10 } }] };
  assert.deepEqual(item_after(mission, "", 1), { index: 1, id: "speed" });
  assert.deepEqual(item_after(mission, "speed", 1), { index: 2, id: "b" });
  assert.equal(item_after(mission, "b", 1), undefined);
  assert.equal(item_after(mission, "none", 1), undefined);
  const east_m = (after: string) => way_of_insert(mission, after, 1, at(5, 5), at(0, 9)).map((each) => Math.round(offset_of(zero, each).east_m));
  assert.deepEqual(east_m(""), [5, 0, 20]); // from the vehicle
  assert.deepEqual(east_m("a"), [10, 0, 20]);
  assert.deepEqual(east_m("b"), [20, 0]);
});
