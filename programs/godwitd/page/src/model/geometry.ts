// Distances and small plane geometry on the map. Degrees (WGS 84) and metres on a sphere: good to half a percent, for
// what people look at. Pure.
import type { mission_document, place, plan_view } from "./messages.ts";

const metres_a_degree = 111_194.93;
const radians = Math.PI / 180;

export interface offset {
  east_m: number;
  north_m: number;
}

export function offset_of(from: place, to: place): offset {
  return {
    east_m: (to.longitude - from.longitude) * metres_a_degree * Math.cos(from.latitude * radians),
    north_m: (to.latitude - from.latitude) * metres_a_degree,
  };
}

export function moved(from: place, by: offset): place {
  return {
    latitude: from.latitude + by.north_m / metres_a_degree,
    longitude: from.longitude + by.east_m / (metres_a_degree * Math.cos(from.latitude * radians)),
  };
}

export function distance_m(from: place, to: place): number {
  const by = offset_of(from, to);
  return Math.hypot(by.east_m, by.north_m);
}

// Clockwise from north, 0 to 360.
export function bearing_deg(from: place, to: place): number {
  const by = offset_of(from, to);
  return (Math.atan2(by.east_m, by.north_m) / radians + 360) % 360;
}

// How far POINT is from the straight piece between A and B.
export function deviation_m(point: place, a: place, b: place): number {
  const line = offset_of(a, b);
  const to = offset_of(a, point);
  const length = Math.hypot(line.east_m, line.north_m);
  if (length === 0) return Math.hypot(to.east_m, to.north_m);
  const along = Math.min(1, Math.max(0, (to.east_m * line.east_m + to.north_m * line.north_m) / length ** 2));
  return Math.hypot(to.east_m - along * line.east_m, to.north_m - along * line.north_m);
}

// 1, 2 or 5 times a power of ten, at least METRES.
export function round_step_m(metres: number): number {
  const power = 10 ** Math.floor(Math.log10(metres));
  for (const each of [1, 2, 5]) if (each * power >= metres * 0.9999) return each * power;
  return 10 * power;
}

export function is_place(at: place | null | undefined): at is place {
  return at !== null && at !== undefined && Number.isFinite(at.latitude) && Number.isFinite(at.longitude) &&
    (at.latitude !== 0 || at.longitude !== 0);
}

export interface shown_item {
  index: number;
  id: string;
  kind: string;
  at: place;
}

function middle_of(corners: place[]): place | undefined {
  if (corners.length === 0) return undefined;
  const mean = (of: (each: place) => number) => corners.reduce((sum, each) => sum + of(each), 0) / corners.length;
  return { latitude: mean((each) => each.latitude), longitude: mean((each) => each.longitude) };
}

// Of an item that goes to the vehicle as it came: its parameters 5 and 6.
function place_of_command(params: unknown): place | undefined {
  if (!Array.isArray(params)) return undefined;
  const at = { latitude: params[4] as number, longitude: params[5] as number };
  return is_place(at) ? at : undefined;
}

// The items that have a place, where they are; of an area its middle.
export function items_of(mission: mission_document): shown_item[] {
  const result: shown_item[] = [];
  mission.items.forEach((item, index) => {
    const at = is_place(item.at) ? item.at : (place_of_command(item["params"]) ?? middle_of(item.polygon ?? []));
    if (is_place(at)) result.push({ index, id: item.id, kind: item.kind, at });
  });
  return result;
}

// The way through the plan: as the vehicle has it, or as the mission names its places while no plan is there.
export function way_of(view: plan_view): place[] {
  if (view.way.length > 0) return view.way;
  return view.mission === null ? [] : items_of(view.mission).map((each) => each.at);
}

// The item that comes after the one with the id AFTER; empty: after the DONE first ones. None: there is no further one.
export function item_after(mission: mission_document, after: string, done: number): { index: number; id: string } | undefined {
  const index = after === "" ? done : mission.items.findIndex((each) => each.id === after) + 1;
  const item = after !== "" && index === 0 ? undefined : mission.items[index];
  return item === undefined ? undefined : { index, id: item.id };
}

// The way of a waypoint at TARGET that is inserted after AFTER: from there, or from the vehicle, and on with the mission.
export function way_of_insert(mission: mission_document | null, after: string, done: number, vehicle: place | undefined, target: place): place[] {
  const items = mission === null ? [] : items_of(mission);
  const from = after === "" ? vehicle : (items.find((each) => each.id === after)?.at ?? vehicle);
  const next = mission === null ? undefined : item_after(mission, after, done);
  const to = next === undefined ? undefined : items.find((each) => each.index >= next.index)?.at;
  return [from, target, to].filter(is_place);
}

// All that should be seen at first.
export function extent_of(view: plan_view | undefined, vehicle: place | undefined): place[] {
  const result: place[] = vehicle === undefined ? [] : [vehicle];
  if (view === undefined) return result;
  result.push(...way_of(view));
  if (is_place(view.home)) result.push(view.home);
  for (const fence of view.mission?.geofences ?? []) if (fence.kind === "INCLUSION") result.push(...fence.vertices);
  return result;
}

// What a map shows: moved around the world, a longitude may be any number.
export interface shown_part {
  west: number;
  south: number;
  east: number;
  north: number;
}

// As the API takes it.
export function bbox_of(part: shown_part): string {
  const is_all = part.east - part.west >= 360;
  const wrapped = (degrees: number) => ((((degrees + 180) % 360) + 360) % 360) - 180;
  const [west, east] = is_all ? [-180, 180] : [wrapped(part.west), wrapped(part.east)];
  const clamped = (degrees: number) => Math.max(-90, Math.min(90, degrees));
  return [west, clamped(part.south), east, clamped(part.north)].map((each) => each.toFixed(6)).join(",");
}
