#!/usr/bin/env node
// The sequences in which other programs fly a mission, through godwitd, with node-mavlink as the station:
//
//   node sequences_check.mjs GODWIT_SIM GODWITD rover|px4|ardupilot mavsdk|mavproxy|part
//
// mavsdk:   upload; arm and the mission mode in one breath (DO_SET_MODE); pause and go on by modes; return.
// mavproxy: upload; GUIDED, arm, take off (SET_MODE, COMMAND_LONG); AUTO in the air; LOITER and AUTO again; RTL.
// part:     upload; MISSION_START of a part while disarmed, which prepares it; arm and the same start; it ends there.
// godwitd arms nothing here. Exit 0 if all is as it must be, 1 if not, 2 on wrong usage.
import { fly_with_daemon, main_of } from "./flying_daemon.mjs";
import { check, compare, item, nav_return, nav_takeoff, square } from "./plans.mjs";

const accepted = 0;
const temporarily_rejected = 1;
const denied = 2;
const in_progress = 5;
const mission_start = 300;
const do_set_mode = 176;
const arm = 400;
const custom_mode_enabled = 1;
const is_armed = 128;
const side_m = 400; // far enough that no sequence comes to the end of the plan

const flight = [item(nav_takeoff, 0, 0, 10), ...square(10, side_m), { ...item(nav_return, 0, 0, 0), frame: 2 }];
const vehicles = {
  rover: { plan: square(0, side_m), mission: [10], hold: [4], home: [11] },
  px4: { plan: flight, mission: [4, 4], hold: [4, 3], home: [4, 5] },
  ardupilot: { plan: flight, mission: [3], hold: [17], home: [6], guided: [4], loiter: [5] },
};

const number_of = ([main, sub]) => (sub === undefined ? main : (main << 16 | sub << 24) >>> 0);

// A person's: by then a heartbeat has shown godwit, too, what the station has seen.
const a_moment = () => new Promise((go) => setTimeout(go, 1500));

async function see_mode(station, mode, within_ms = 10_000) {
  const shows = ({ autopilot, customMode }) => autopilot !== 8 && customMode === number_of(mode);
  check(await station.wait_for(["HEARTBEAT"], shows, within_ms), `the vehicle does not show mode ${mode}`);
}

async function change_mode(station, mode) {
  const result = await station.command(do_set_mode, [custom_mode_enabled, ...mode]);
  check(result === accepted, `mode ${mode} is answered with ${result}`);
}

// Refused for now: the plan is still being checked, or brought to the vehicle; nothing has begun then.
async function start_by_mode(station, mode) {
  for (const end = Date.now() + 30_000; Date.now() < end; await new Promise((go) => setTimeout(go, 200))) {
    const result = await station.command(do_set_mode, [custom_mode_enabled, ...mode]);
    if (result === accepted) return;
    check(result === temporarily_rejected, `mode ${mode} is answered with ${result}`);
  }
  throw new Error("the mission can not be started within 30 s");
}

async function see_progress(station) {
  check(await station.wait_for(["MISSION_CURRENT"], ({ missionState, seq }) => missionState === 3 && seq >= 0, 20_000),
    "the mission is not shown as active");
}

async function see_in_air(station) {
  const in_air = ({ relativeAlt }) => relativeAlt > 8_000;
  check(await station.wait_for(["GLOBAL_POSITION_INT"], in_air, 20_000), "the vehicle does not take off");
}

async function prepare(station, { plan }) {
  check(await station.wait_for(["HEARTBEAT"], undefined, undefined, 0), "no heartbeat of the vehicle is forwarded");
  check(await station.upload(plan) === accepted, "the upload was refused");
  compare(plan, await station.download(), 0);
  const is_ready = ({ text }) => text.startsWith("ready");
  check(await station.wait_for(["STATUSTEXT"], is_ready, 60_000, 0), "the flight does not become ready");
}

async function as_mavsdk(station, vehicle) {
  await prepare(station, vehicle);
  check(await station.command(arm, [1]) === accepted, "arming is refused");
  await start_by_mode(station, vehicle.mission);
  await see_progress(station);
  if (vehicle.plan === flight) await see_in_air(station);
  await change_mode(station, vehicle.hold);
  await see_mode(station, vehicle.hold);
  await change_mode(station, vehicle.mission);
  await see_mode(station, vehicle.mission);
  await a_moment();
  await change_mode(station, vehicle.home);
  await see_mode(station, vehicle.home);
}

async function as_mavproxy(station, vehicle) {
  const set_mode = (mode) => station.send("SET_MODE", { targetSystem: 1, baseMode: custom_mode_enabled, customMode: number_of(mode) });
  await prepare(station, vehicle);
  set_mode(vehicle.guided);
  await see_mode(station, vehicle.guided);
  check(await station.command(arm, [1]) === accepted, "arming is refused");
  const armed = ({ autopilot, baseMode }) => autopilot !== 8 && (baseMode & is_armed) !== 0;
  check(await station.wait_for(["HEARTBEAT"], armed, 10_000), "the vehicle is not armed");
  check(await station.command(nav_takeoff, [0, 0, 0, 0, 0, 0, 10]) === accepted, "the take-off is refused");
  await see_in_air(station);
  set_mode(vehicle.mission);
  await see_mode(station, vehicle.mission);
  await see_progress(station);
  set_mode(vehicle.loiter);
  await see_mode(station, vehicle.loiter);
  await a_moment();
  set_mode(vehicle.mission);
  await see_mode(station, vehicle.mission);
  set_mode(vehicle.home);
  await see_mode(station, vehicle.home);
}

// Until it is answered otherwise than "not yet".
async function start_part(station, first, last) {
  for (const end = Date.now() + 30_000; Date.now() < end; await new Promise((go) => setTimeout(go, 200))) {
    const result = await station.command(mission_start, [first, last]);
    if (result !== temporarily_rejected && result !== in_progress) return result;
  }
  throw new Error("a part of the mission can not be started within 30 s");
}

async function as_part(station, vehicle) {
  await prepare(station, vehicle);
  const first = vehicle.plan === flight ? 2 : 1; // what flies takes off before it
  const told = () => station.heard.filter(({ name }) => name === "MISSION_ITEM_REACHED").map(({ message }) => message.seq);
  check(await start_part(station, first, first) === denied, "a vehicle that is disarmed is started");
  check(await station.command(arm, [1]) === accepted, "arming is refused");
  const result = await start_part(station, first, first);
  check(result === accepted, `the start of item ${first} is answered with ${result}`);
  check(await station.wait_for(["MISSION_ITEM_REACHED"], ({ seq }) => seq === first, 60_000, 0), "it is not reached");
  await new Promise((go) => setTimeout(go, 3_000)); // a minute of the vehicle
  const items = [...new Set(told())];
  compare(vehicle.plan, await station.download(), 0);
  check(JSON.stringify(items) === JSON.stringify(vehicle.plan === flight ? [0, first] : [first]), `reached: ${items}`);
}

const names = [...Object.keys(vehicles).flatMap((each) => [`${each} mavsdk`, `${each} part`]), "ardupilot mavproxy"];
await main_of("sequences_check.mjs", names, async (vehicle_path, daemon_path, name, program) => {
  const began = Date.now();
  const fly = { mavsdk: as_mavsdk, mavproxy: as_mavproxy, part: as_part }[program];
  await fly_with_daemon(vehicle_path, daemon_path, name, [], (station) => fly(station, vehicles[name]));
  console.log(`${name} as ${program} flies it: ${Date.now() - began} ms`);
});
