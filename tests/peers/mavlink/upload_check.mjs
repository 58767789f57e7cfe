#!/usr/bin/env node
// What godwit puts on a vehicle from a mission file, against a direct upload of the same file by node-mavlink:
//
//   node upload_check.mjs [OPTION...] GODWIT_SIM GODWITD GODWIT_TRACE FILE|FOLDER...
//
// Two simulated vehicles of one kind, 5 m from the home of the file: node-mavlink uploads mission, fence and rally
// points of the file to one of them, godwitd prepares the flight of the other. Both are read back, and each item must
// be equal in every field. A field may differ for a reason that is listed here; whatever else differs is an error.
// What holds a fence or rally points alone is no mission: godwit-trace uploads it. Where godwit uploads nothing, its
// own words say why, and the file counts apart. A line for each file, the last one counts them.
//
// --station: godwitd does not read the file; the same upload goes to its port, and from there to the vehicle.
// --expected TSV: which vehicle each file is for, as tests/data/missions/expected.tsv has it; else what the file says,
// or an ArduCopter. --all: a file of which nothing is uploaded is an error, too. --changed: a field of the last item is
// uploaded with another value, so the check must fail. Exit 0 if nothing differs without a reason, 1 if something
// does, 2 on wrong usage.
import { spawn, spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, join } from "node:path";

import { load_definitions } from "./definitions.mjs";
import { free_port, with_vehicle } from "./flying_daemon.mjs";
import { end, ground_station } from "./ground_station.mjs";
import { files_of, read_mission_file } from "./mission_file.mjs";

const [mission_type, fence_type, rally_type] = [0, 1, 2];
const types = ["mission", "fence", "rally"];
const [rtl, land, takeoff, vtol_takeoff, jump, speed, return_point] = [20, 21, 22, 84, 177, 178, 5000];
const unset = 2 ** 31 - 1; // MISSION_ITEM_INT: no coordinate
const units_per_degree = 1e7;
const highest_home_m = 9_000; // of godwit-sim
const patience_ms = 20_000; // for a vehicle that becomes ready at twenty times real time
const upload_patience_ms = 60_000;
const fence_patience_ms = 15_000;
const ardupilot_firmware = 3;

// The simulated vehicles; a VTOL takes the items of what it is most like.
const vehicles = { arducopter: "ardupilot", arduplane: "plane", quadplane: "plane", ardurover: "ardurover",
  "px4-multicopter": "px4", "px4-vtol": "px4", "px4-fixed-wing": "px4", "px4-rover": "px4" };
const types_of_plans = { 1: "plane", 10: "ardurover", 20: "plane" };

function vehicle_for(path, { vehicle }, rows) {
  if (rows.has(basename(path))) return vehicles[rows.get(basename(path))];
  if (vehicle?.autopilot === ardupilot_firmware) return types_of_plans[vehicle.type] ?? "ardupilot";
  return vehicle ? "px4" : "ardupilot";
}

// -- the direct upload ------------------------------------------------------------------------------

const has_place = (frame) => frame !== 2;

// As a station puts it: ArduPilot takes no NaN, and item 0 is its home.
function wire_items({ items, home }, is_ardupilot, is_mission = true) {
  const first = is_ardupilot && is_mission ? 1 : 0;
  const plain = (value) => (is_ardupilot && Number.isNaN(value) ? 0 : value);
  const coordinate = (value, frame) => Number.isNaN(value) ? (is_ardupilot || !has_place(frame) ? 0 : unset)
    : Math.round(value * (has_place(frame) ? units_per_degree : 1));
  const made = items.map(({ command, frame, params: [p1, p2, p3, p4, x, y, z], autocontinue }, index) => ({ command,
    frame, current: is_mission && index === 0 ? 1 : 0, autocontinue, param1: plain(command === jump ? p1 + first : p1),
    param2: plain(p2), param3: plain(p3), param4: plain(p4), x: coordinate(x, frame), y: coordinate(y, frame),
    z: plain(z) }));
  const [latitude = 0, longitude = 0, height = 0] = home ?? [];
  const at_home = { command: 16, frame: 0, current: 0, autocontinue: 1, param1: 0, param2: 0, param3: 0, param4: 0,
    x: coordinate(latitude, 0), y: coordinate(longitude, 0), z: height };
  return first === 1 ? [at_home, ...made] : made;
}

function uploads_of(file, is_ardupilot) {
  const [fence, rally] = [file.fence, file.rally].map((items) => wire_items({ items }, is_ardupilot, false));
  return [file.items.length > 0 ? wire_items(file, is_ardupilot) : [], fence, rally];
}

// Fence and rally points before the mission. Why STATION is refused; nothing: it is not.
async function upload_lists(station, lists) {
  for (const type of [fence_type, rally_type, mission_type]) {
    const result = lists[type].length === 0 ? 0 : await station.upload(lists[type], type);
    if (result !== 0) return `the upload of the ${types[type]} is refused with ${result}`;
  }
  return undefined;
}

// -- what differs, and why it may -------------------------------------------------------------------

const fields = ["command", "frame", "current", "autocontinue", "param1", "param2", "param3", "param4", "x", "y", "z"];
const is_above_home = (frame) => frame === 3 || frame === 6;

// FIELD of item N differs: SENT is what was uploaded directly, DIRECT and OURS are read back.
const reasons = [
  { why: "a take-off without a place climbs where the vehicle stands", holds: (_, field, { command, x, y }) =>
    command === takeoff && (field === "x" || field === "y") && (x === unset || (x === 0 && y === 0)) },
  { why: "what is not given goes as 0, which means the same there", holds: (_, field, { command, [field]: value },
    { ours }) => [16, 19, 21, takeoff].includes(command) && Number.isNaN(value) && ours[field] === 0 },
  { why: "a PX4 has no place that means here: it lands at the item before it", holds: (_, field, { command, x, y },
    { is_ardupilot }) => !is_ardupilot && command === land && (field === "x" || field === "y") && x === unset &&
    y === unset },
  { why: "it has no place, so its frame says nothing", holds: (_, field, { command }) =>
    [rtl, jump, speed].includes(command) && ["frame", "x", "y", "z"].includes(field) },
  { why: "frames 3 and 6 mean the same", holds: (_, field, __, { direct, ours }) =>
    field === "frame" && is_above_home(direct.frame) && is_above_home(ours.frame) },
  { why: "vehicles keep no height of a fence's place of return", holds: (_, field, { command }) =>
    command === return_point && field === "z" },
];

const is_same = (a, b) => a === b || (Number.isNaN(a) && Number.isNaN(b));

const is_return_point = ({ command }) => command === return_point;

// Godwit puts it behind the corners.
const return_point_last = (items) =>
  [...items.filter((each) => !is_return_point(each)), ...items.filter(is_return_point)];

// The first of ITEMS that moves the vehicle is a take-off.
const begins_with_takeoff = (items) =>
  [takeoff, vtol_takeoff].includes(items.find(({ command }) => command < 95)?.command);

function compare(sent, direct, ours, context) {
  const errors = [];
  const excused = new Map();
  if (context.is_station && direct.some(is_return_point) && !ours.some(is_return_point)) {
    excused.set("a station's fence is used without its place of return, and the station is told", 1);
    [sent, direct] = [sent, direct].map((items) => items.filter((each) => !is_return_point(each)));
  }
  const next = direct.slice(ours.length);
  if (context.type === mission_type && ours.length > 0 && begins_with_takeoff(next))
    excused.set("after a landing the take-off begins the next plan", next.length);
  else if (direct.length !== ours.length)
    return { errors: [`${types[context.type]}: ${ours.length} items, directly ${direct.length}`], excused };
  if (direct.some(({ command }, n) => command !== ours[n]?.command && command === return_point)) {
    excused.set("the place of return of a fence may stand anywhere", 1);
    [sent, direct, ours] = [sent, direct, ours].map(return_point_last);
  }
  for (const [n, each] of direct.slice(0, ours.length).entries()) {
    if (each.missionType !== ours[n].missionType) errors.push(`item ${n}: another mission type`);
    for (const field of fields.filter((name) => !is_same(each[name], ours[n][name]))) {
      const found = reasons.find(({ holds }) => holds(n, field, sent[n], { ...context, direct: each, ours: ours[n] }));
      if (found) excused.set(found.why, (excused.get(found.why) ?? 0) + 1);
      else errors.push(`${types[context.type]} item ${n} (${each.command}): ${field} is ${ours[n][field]}, directly ` +
        `${each[field]}`);
    }
  }
  return { errors, excused };
}

// -- what godwit does ------------------------------------------------------------------------------

// Why the flight does not become ready; nothing: it is, and what it needs is on the vehicle. SOURCE: options of godwitd
// that say where the mission comes from. HAND_OVER may bring it there, and says why that was refused.
async function prepare(daemon_path, source, port, folder, hand_over = async () => undefined) {
  const journal = join(folder, "godwit.db");
  const options = ["--vehicle", `udpout://127.0.0.1:${port}`, ...source, "--journal", journal, "--trace",
    join(folder, "trace")];
  const daemon = spawn(daemon_path, options, { stdio: ["ignore", "ignore", "pipe"] });
  let said = "";
  daemon.stderr.setEncoding("utf8");
  daemon.stderr.on("data", (text) => { said += text; });
  const control = (...words) => spawnSync(daemon_path, ["ctl", ...words, "--journal", journal], { encoding: "utf8" });
  let sentence = "it did not start";
  let acknowledged = 0;
  const began = Date.now();
  const refusal = await hand_over();
  if (refusal) return { daemon, why: refusal };
  const patience = () => (sentence === "uploading" ? upload_patience_ms : patience_ms);
  for (; Date.now() - began < patience(); await new Promise((go) => setTimeout(go, 200))) {
    if (daemon.exitCode !== null) return { daemon, why: said.trim().split("\n").slice(0, 2).join(" ") };
    const { stdout, status } = control("status", "--json");
    if (status !== 0) continue;
    const { flight } = JSON.parse(stdout);
    sentence = flight.sentence;
    if (flight.phase === "ready") return { daemon };
    if (flight.phase === "paused") break;
    if (flight.preflight_report !== 0 && flight.preflight_report !== acknowledged) {
      acknowledged = flight.preflight_report;
      control("ack", String(acknowledged));
    }
    if (/can not be flown|can not be carried|fences|not for this place/.test(sentence)) break;
  }
  return { daemon, why: sentence };
}

// A fence or rally points alone.
function upload_list(programs, path, file, port, folder) {
  const type = file.fence.length > 0 ? "fence" : "rally";
  let lines = path;
  if (path.endsWith(".plan")) {
    lines = join(folder, "alone.waypoints");
    const made = spawnSync(programs.daemon, ["convert", path, lines], { encoding: "utf8" });
    if (made.status !== 0) return { why: made.stderr.trim().split("\n")[0] };
  }
  const done = spawnSync(programs.trace, ["upload", `udpout://127.0.0.1:${port}`, lines, "--type", type],
    { encoding: "utf8" });
  return done.status === 0 ? {} : { why: (done.stdout + done.stderr).trim() };
}

// Over the port of godwitd.
async function prepare_for_station(daemon_path, lists, port, folder, definitions) {
  const ground = await free_port();
  const hand_over = () => with_station(ground, definitions, async (station) => {
    await station.wait_for(["HEARTBEAT"], undefined, undefined, 0);
    return upload_lists(station, lists);
  });
  return prepare(daemon_path, ["--ground", `udpin://127.0.0.1:${ground}`], port, folder, hand_over);
}

// WANTED: so long are the lists of the direct upload. Fence and rally points come when the flight is ready.
async function upload_by_godwit({ programs, is_station }, path, file, uploads, [port, other], wanted, folder,
  definitions) {
  const is_alone = file.items.length === 0;
  const { daemon, why } = is_alone ? upload_list(programs, path, file, port, folder)
    : is_station ? await prepare_for_station(programs.daemon, uploads, port, folder, definitions)
      : await prepare(programs.daemon, ["--mission", path], port, folder);
  try {
    if (why) return { why };
    // A PX4 that is read takes no upload meanwhile: seldom, and not while they come.
    for (const until = Date.now() + fence_patience_ms; ; ) {
      if (!is_alone && wanted[fence_type] + wanted[rally_type] > 0) await new Promise((go) => setTimeout(go, 3_000));
      const lists = await read_back(other, definitions);
      if (lists.every(({ length }, type) => length === wanted[type]) || Date.now() > until) return { lists };
    }
  } finally {
    await end(daemon);
  }
}

async function with_station(port, definitions, use) {
  const station = new ground_station(port, definitions);
  try {
    return await use(station);
  } finally {
    station.close();
  }
}

const read_back = (port, definitions) => with_station(port, definitions, async (station) => {
  const lists = [];
  for (const type of [mission_type, fence_type, rally_type]) lists.push(await station.download(type));
  return lists;
});

// -- one file --------------------------------------------------------------------------------------

// Where both vehicles begin: some metres from home, so that it matters whose place an item has.
function start_of(file) {
  const placed = [...file.items, ...file.fence, ...file.rally].find(({ params }) => params[4] && params[5]);
  const [latitude, longitude, height] = file.home ?? placed?.params.slice(4) ?? [47.397742, 8.545594];
  const is_height = file.home && height > 0 && height < highest_home_m;
  return [latitude + 0.000045, longitude, is_height ? height : 488].join(",");
}

function verdict(file, found, count) {
  const errors = found.flatMap((each) => each.errors);
  const excused = found.flatMap((each) => [...each.excused]).map(([why, times]) => `${why} (${times})`);
  if (errors.length > 0 && file.has_area)
    return { outcome: "not compared", text: "godwit lays the lines of its survey itself" };
  if (errors.length > 0)
    return { outcome: "DIFFERS", text: `${errors.length} fields: ${errors.slice(0, 3).join("; ")}` };
  return { outcome: excused.length > 0 ? "equal but" : "equal", text: [`${count} items`, ...excused].join("; ") };
}

async function check_file(given, path, definitions, folder) {
  const { programs, rows, is_changed } = given;
  const file = read_mission_file(path);
  const personality = vehicle_for(path, file, rows);
  const is_ardupilot = personality !== "px4";
  const uploads = uploads_of(file, is_ardupilot);
  if (is_changed) uploads.find((items) => items.length > 0).at(-1).param2 += 1;
  const vehicle = { personality, home: start_of(file), lines: 2 };
  const direct = await with_vehicle(programs.vehicle, vehicle, async ([port]) => {
    const why = await with_station(port, definitions, (station) => upload_lists(station, uploads));
    return why ? { why: `directly: ${why}` } : { lists: await read_back(port, definitions) };
  });
  if (direct.why) return { outcome: "not uploaded", text: direct.why };
  const lengths = direct.lists.map((items) =>
    items.filter((each) => !given.is_station || !is_return_point(each)).length);
  const { why, lists } = await with_vehicle(programs.vehicle, vehicle, (ports) =>
    upload_by_godwit(given, path, file, uploads, ports, lengths, folder, definitions));
  if (why) return { outcome: "not uploaded", text: why };
  return verdict(file, lists.map((ours, type) =>
    compare(uploads[type], direct.lists[type], ours, { is_ardupilot, type, is_station: given.is_station })),
  direct.lists.flat().length);
}

// -- the program -----------------------------------------------------------------------------------

const flags = ["--changed", "--all", "--station"];

function arguments_of(given) {
  const at = given.indexOf("--expected");
  const rows = new Map();
  if (at >= 0) {
    const [, table] = given.splice(at, 2);
    for (const line of readFileSync(table, "utf8").split("\n")) rows.set(...line.split("\t"));
  }
  const [is_changed, needs_all, is_station] = flags.map((each) => given.includes(each));
  const [vehicle, daemon, trace, ...places] = given.filter((each) => !flags.includes(each));
  return { programs: { vehicle, daemon, trace }, files: files_of(places), rows, is_changed, needs_all,
    is_station };
}

const given = arguments_of(process.argv.slice(2));
if (given.files.length === 0) {
  console.error("usage: upload_check.mjs [--station] [--expected TSV] [--all] [--changed] GODWIT_SIM GODWITD " +
    "GODWIT_TRACE FILE|FOLDER...");
  process.exit(2);
}
const definitions = await load_definitions();
const counts = {};
for (const path of given.files) {
  const folder = mkdtempSync(join(tmpdir(), "godwit-upload-"));
  const { outcome, text } = await check_file(given, path, definitions, folder).catch((error) =>
    ({ outcome: "FAILED", text: error.message }));
  rmSync(folder, { recursive: true });
  counts[outcome] = (counts[outcome] ?? 0) + 1;
  console.log(`${outcome.padEnd(12)} ${basename(path)}  ${text}`);
}
console.log(Object.entries(counts).map(([outcome, count]) => `${count} ${outcome}`).join(", "));
const errors = ["DIFFERS", "FAILED", ...(given.needs_all ? ["not uploaded"] : [])];
process.exitCode = errors.some((each) => counts[each]) ? 1 : 0;
