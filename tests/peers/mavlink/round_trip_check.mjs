#!/usr/bin/env node
// Mission files through godwit's own form and back to theirs, equal in meaning:
//
//   node round_trip_check.mjs GODWITD [--changed] FILE|FOLDER...
//
// `godwitd convert` writes each file as JSON and that in the form in which it came; a fence or rally points alone,
// which are no mission, go straight from form to form. mission_file.mjs, which is not ours, reads what was and what
// came back. A plan that is written as a plan keeps all that is in it, which is checked too. What means nothing may
// change: frames 3 and 6, 0 and 5, 10 and 11 are the same; a return, a jump and a change of speed have no place; a
// yaw of 0 is none to an ArduPilot, and what is not given is 0 where godwit plans an item; a survey of an area is its
// pattern, of which the lines are laid again. A line for each file, the last one counts them. --changed: a field of
// the first item is taken for another, so the check must fail. Exit 0 if none differs, 1 if one does, 2 on wrong usage.
import { spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, join } from "node:path";

import { files_of, read_mission_file } from "./mission_file.mjs";

const [waypoint, loiter_time, rtl, land, takeoff, jump, speed] = [16, 19, 20, 21, 22, 177, 178];
const placeless = [rtl, jump, speed];
const ardupilot_firmware = 3;
const vehicle_class = (type) => ([13, 14, 15].includes(type) ? 2 : [19, 21, 22].includes(type) ? 20 : type);
const frame_of = (frame) => ({ 5: 0, 6: 3, 11: 10 }[frame] ?? frame);
// A plan keeps all digits of a number, a line seven of a degree and those of a float.
const is_same = (a, b, is_degrees) => Object.is(a, b) || a === b ||
  Math.abs(a - b) <= (is_degrees ? 6e-8 : 1e-6 * Math.max(1, Math.abs(a)));

function item_text({ command, frame, params, autocontinue }, is_ardupilot) {
  const has_place = !placeless.includes(command);
  const is_planned = [waypoint, loiter_time, land, takeoff].includes(command);
  const is_zero = (n) => (n < 3 && is_planned) || (n === 3 && is_ardupilot);
  const given = params.map((each, n) => (is_zero(n) && Number.isNaN(each) ? 0 : each));
  return { command, frame: has_place ? frame_of(frame) : "none", params: has_place ? given : given.slice(0, 4),
    autocontinue: command >= 5000 ? 0 : autocontinue }; // a fence does not go on
}

function differences(before, after) {
  const found = [];
  const is_ardupilot = before.vehicle?.autopilot === ardupilot_firmware;
  const kind = ({ vehicle }) => vehicle && `firmware ${vehicle.autopilot}, type ${vehicle_class(vehicle.type)}`;
  if (before.vehicle?.type !== undefined && kind(before) !== kind(after))
    found.push(`${kind(before)} is ${kind(after)}`);
  if (Boolean(before.home) !== Boolean(after.home) ||
    before.home?.some((each, n) => !is_same(each, after.home[n], n < 2)))
    found.push(`home ${before.home} is ${after.home}`);
  for (const list of ["items", "fence", "rally"]) {
    if (before[list].length !== after[list].length) {
      found.push(`${before[list].length} of ${list} are ${after[list].length}`);
      continue;
    }
    for (const [n, each] of before[list].entries()) {
      const [a, b] = [each, after[list][n]].map((one) => item_text(one, is_ardupilot));
      const is_here = each.command === land && !is_ardupilot && Number.isNaN(each.params[4]);
      if (is_here) b.params.splice(4, 2, NaN, NaN); // which a PX4 does not know: the place of the item before it
      const is_equal = a.command === b.command && a.frame === b.frame && a.autocontinue === b.autocontinue &&
        a.params.every((value, i) => is_same(value, b.params[i], i === 4 || i === 5));
      if (!is_equal) found.push(`${list} ${n}: ${JSON.stringify(a)} is ${JSON.stringify(b)}`);
    }
  }
  return found;
}

function convert(daemon, from, to) {
  const done = spawnSync(daemon, ["convert", from, to], { encoding: "utf8" });
  return done.status === 0 ? "" : done.stderr.trim().replace(/^godwitd: /, "").split("\n").slice(0, 2).join(" ");
}

function check_file(daemon, path, folder, is_changed) {
  const is_plan = /\.(plan|mission)$/i.test(path);
  const [ours, back, again] = ["ours.json", `back.${is_plan ? "plan" : "waypoints"}`,
    `again.${is_plan ? "plan" : "waypoints"}`].map((name) => join(folder, name));
  const direct = convert(daemon, path, again);
  if (direct) return { outcome: "refused", text: direct };
  const before = read_mission_file(path);
  if (is_changed) [...before.items, ...before.fence, ...before.rally][0].params[1] += 1;
  const why = before.items.length > 0 ? convert(daemon, path, ours) || convert(daemon, ours, back) : "";
  if (why) return { outcome: "refused", text: why };
  const found = differences(before, read_mission_file(again));
  if (before.items.length > 0) {
    const has_area = before.has_area && read_mission_file(back).has_area;
    found.push(...differences(...[path, back].map((each) => read_mission_file(each, has_area))));
  }
  const plan = is_plan ? JSON.parse(readFileSync(path, "utf8")) : undefined;
  if (plan?.mission?.version === 2 &&
    JSON.stringify(sorted(plan)) !== JSON.stringify(sorted(JSON.parse(readFileSync(again, "utf8")))))
    found.push("the plan is not written again as it is");
  return { outcome: found.length === 0 ? "equal" : "DIFFERS", text: found.slice(0, 3).join("; ") };
}

// With the keys of all objects in the order of the alphabet.
function sorted(value) {
  if (Array.isArray(value)) return value.map(sorted);
  if (value === null || typeof value !== "object") return value;
  return Object.fromEntries(Object.keys(value).sort().map((key) => [key, sorted(value[key])]));
}

const is_changed = process.argv.includes("--changed");
const [daemon, ...places] = process.argv.slice(2).filter((each) => each !== "--changed");
const files = files_of(places);
if (files.length === 0) {
  console.error("usage: round_trip_check.mjs GODWITD [--changed] FILE|FOLDER...");
  process.exit(2);
}
const counts = {};
const folder = mkdtempSync(join(tmpdir(), "godwit-round-"));
try {
  for (const path of files) {
    const { outcome, text } = check_file(daemon, path, folder, is_changed);
    counts[outcome] = (counts[outcome] ?? 0) + 1;
    console.log(`${outcome.padEnd(8)} ${basename(path)}  ${text}`.trimEnd());
  }
} finally {
  rmSync(folder, { recursive: true });
}
console.log(Object.entries(counts).map(([outcome, count]) => `${count} ${outcome}`).join(", "));
process.exitCode = counts.DIFFERS ? 1 : 0;
