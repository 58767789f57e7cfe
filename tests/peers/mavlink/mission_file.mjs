// Mission files as their formats describe them, read by nothing of ours: what a ground station would upload from one.
//
//   { vehicle: { autopilot, type } or undefined, home: [latitude, longitude, height] or undefined,
//     items, fence, rally: { command, frame, params: 7 numbers, autocontinue }, has_area }
//
// `has_area`: there is a survey of an area without camera and turns, whose lines godwit lays itself. With AS_PATTERN it
// is one item, "survey", with its altitude, the distance and heading of its lines and its corners.
//
// What is not given is NaN. A DO_JUMP names its target by its place in `items`, from 0 on, where it leads to one.
// Sources: QGroundControl's developer guide, "Plan File Format"; the MAVLink guide, "File Formats"; MAVProxy's fence
// and rally modules.
import { readFileSync, readdirSync, statSync } from "node:fs";
import { join } from "node:path";

const nav_waypoint = 16;
const do_jump = 177;
const [return_point, keep_in, keep_out, circle_in, circle_out, rally_point] = [5000, 5001, 5002, 5003, 5004, 5100];
const [above_sea, no_place, above_home] = [0, 2, 3]; // MAV_FRAME

const number = (value) => (typeof value === "number" ? value : NaN);
const item = (command, frame, params, autocontinue = 1) => ({ command, frame, params, autocontinue });
const place_item = (command, frame, [latitude, longitude, height], param1 = 0) =>
  item(command, frame, [param1, 0, 0, 0, latitude, longitude, Number.isFinite(height) ? height : 0]);

function ring(corners) {
  const is_closed = corners.length > 1 && corners[0].every((each, i) => each === corners.at(-1)[i]);
  return is_closed ? corners.slice(0, -1) : corners;
}

const polygon = (corners, is_in) => ring(corners).map((each, _, all) =>
  place_item(is_in ? keep_in : keep_out, above_sea, [each[0], each[1], 0], all.length));

function simple_items(each, doc_number) {
  const params = each.params ?? [each.param1, each.param2, each.param3, each.param4];
  return [{ ...item(each.command, each.frame, [...params, ...(params.length === 4 ? each.coordinate : [])].map(number),
    each.autoContinue ? 1 : 0), jump_id: each.doJumpId ?? doc_number }];
}

// The landing that a ground station lays: the mark of its beginning, the end of pictures and films, the way down.
function landing_items(each) {
  const frame = each.altitudesAreRelative ? above_home : above_sea;
  const is_vtol = each.complexItemType !== "fwLandingPattern";
  const approach = each.landingApproachCoordinate ?? each.loiterCoordinate;
  const plain = (command) => item(command, no_place, [0, 0, 0, 0, 0, 0, 0]);
  const radius_m = (each.loiterRadius ?? 0) * (each.loiterClockwise ?? true ? 1 : -1);
  return [plain(189), ...(each.stopTakingPhotos ? [plain(206), plain(2001)] : []),
    ...(each.stopVideoPhotos ? [plain(2501)] : []),
    each.useLoiterToAlt ?? true ? item(31, frame, [1, radius_m, 0, 1, ...approach])
      : item(nav_waypoint, frame, [0, 0, 0, NaN, ...approach]),
    item(is_vtol ? 85 : 21, frame, [0, 0, 0, is_vtol ? NaN : 0, ...each.landCoordinate])];
}

function is_area({ complexItemType, TransectStyleComplexItem: lines }) {
  return complexItemType === "survey" && !lines.TurnAroundDistance &&
    (lines.Items ?? []).every(({ command }) => command === nav_waypoint);
}

function pattern_of({ angle, polygon: corners, TransectStyleComplexItem: { CameraCalc: camera } }) {
  const { DistanceToSurface: altitude_m, AdjustedFootprintSide: spacing_m } = camera;
  return [item("survey", above_home, [altitude_m, spacing_m, angle, ...corners.flat()])];
}

function plan_items(all, as_pattern) {
  return all.flatMap((each, index) => {
    if (each.type !== "ComplexItem") return simple_items(each, index + 1);
    if (as_pattern && is_area(each)) return pattern_of(each);
    const laid = each.TransectStyleComplexItem?.Items ?? [];
    return each.landCoordinate ? landing_items(each) : laid.flatMap((one) => simple_items(one));
  });
}

function read_plan(plan, as_pattern) {
  const mission = plan.mission ?? plan; // a .mission file
  const { polygons = [], circles = [], breachReturn: back } = plan.geoFence ?? {};
  const home = mission.plannedHomePosition.coordinate ?? mission.plannedHomePosition;
  const items = plan_items(mission.items, as_pattern);
  for (const each of items.filter(({ command }) => command === do_jump))
    each.params[0] = items.findIndex(({ jump_id }) => jump_id === each.params[0]);
  return { vehicle: { autopilot: mission.firmwareType ?? mission.MAV_AUTOPILOT, type: mission.vehicleType },
    home: home[0] || home[1] ? home : undefined, items, has_area: mission.items.some(is_area),
    fence: [...polygons.flatMap((each) => polygon(each.polygon, each.inclusion)),
      ...circles.map(({ inclusion, circle: { center, radius } }) =>
        place_item(inclusion ? circle_in : circle_out, above_sea, center, radius)),
      ...(back ? [place_item(return_point, above_sea, [back[0], back[1], 0])] : [])],
    rally: (plan.rallyPoints?.points ?? []).map((each) => place_item(rally_point, above_home, each)) };
}

const rows_of = (text) => text.replace(/^\ufeff/, "").split(/\r\n|\r|\n/).map((line) => line.replace(/#.*/, "").trim())
  .filter((line) => line !== "").map((line) => line.split(/\s+/));

// A header and one item a line; the first is home when it is a waypoint above the sea that says nothing else.
function read_items(rows) {
  const all = rows.map((columns) => {
    const [index, , frame, command, ...rest] = columns.map(Number);
    return { ...item(command, frame, rest.slice(0, 7), rest[7]), index };
  });
  const [first] = all;
  const has_home = [0, nav_waypoint].includes(first.command) && [0, 5].includes(first.frame) &&
    [0, 2, 3].every((n) => !first.params[n]);
  const items = has_home ? all.slice(1) : all;
  for (const each of items.filter(({ command }) => command === do_jump))
    each.params[0] = items.findIndex(({ index }) => index === each.params[0]);
  const is_fence = all.every(({ command }) => command >= return_point && command <= circle_out);
  const is_rally = all.every(({ command }) => command === rally_point);
  return { home: has_home && (first.params[4] || first.params[5]) ? first.params.slice(4) : undefined,
    items: is_fence || is_rally ? [] : items, fence: is_fence ? all : [], rally: is_rally ? all : [] };
}

function read_lines(text) {
  const rows = rows_of(text);
  if (rows[0][0] === "QGC") return read_items(rows.slice(1));
  if (rows[0][0] === "RALLY")
    return { items: [], fence: [], rally: rows.map(([, ...numbers]) =>
      place_item(rally_point, above_home, numbers.map(Number))) };
  const [back, ...corners] = rows.map((columns) => columns.map(Number));
  return { items: [], fence: [place_item(return_point, above_sea, back), ...polygon(corners, true)], rally: [] };
}

export function read_mission_file(path, as_pattern = false) {
  const text = readFileSync(path, "utf8");
  return text.trimStart().startsWith("{") ? read_plan(JSON.parse(text), as_pattern) : read_lines(text);
}

// Each of PLACES that is a file, and the mission files of those that are folders.
export const files_of = (places) => places.flatMap((each) => (statSync(each).isDirectory()
  ? readdirSync(each).filter((name) => /\.(plan|mission|waypoints|txt|fen)$/i.test(name)).sort()
    .map((name) => join(each, name)) : [each]));
