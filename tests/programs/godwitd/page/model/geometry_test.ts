import assert from "node:assert/strict";
import { test } from "node:test";
import { bbox_of } from "../../../../../programs/godwitd/page/src/model/geometry.ts";

test("the part that a map shows is asked for as west, south, east, north", () => {
  assert.equal(bbox_of({ west: 8.5, south: 47.3, east: 8.6, north: 47.4 }), "8.500000,47.300000,8.600000,47.400000");
});

test("a map that was moved around the world asks for the same part, across the antimeridian too", () => {
  assert.equal(bbox_of({ west: 368.5, south: 47.3, east: 368.6, north: 47.4 }), "8.500000,47.300000,8.600000,47.400000");
  assert.equal(bbox_of({ west: 179, south: -1, east: 181, north: 1 }), "179.000000,-1.000000,-179.000000,1.000000");
});

test("a map that shows more than the world asks for all of it", () => {
  assert.equal(bbox_of({ west: -500, south: -95, east: 500, north: 95 }), "-180.000000,-90.000000,180.000000,90.000000");
});
