#!/usr/bin/env node
// node-mavlink as a ground station, against a simulated vehicle:
//
//   node mission_check.mjs GODWIT_SIM rover|px4|ardupilot
//
// Starts the program with a vehicle on a free port, uploads a mission, reads it back, makes the vehicle fly it, follows
// it to its end, and reads it back again. Exit 0 if all is as it must be, 1 if not, 2 on wrong usage.
import { load_definitions } from "./definitions.mjs";
import { with_vehicle } from "./flying_daemon.mjs";
import { ground_station } from "./ground_station.mjs";
import { check, compare, item, nav_land, nav_return, nav_takeoff, nav_waypoint, square } from "./plans.mjs";

const mission_start = 300;
const do_set_mode = 176;
const arm_disarm = 400;
const state_complete = 5;

const flight = [item(nav_takeoff, 0, 0, 10), ...square(10), item(nav_land, 0, 30, 0)];
flight[0].current = 1;

async function until_armed(station) {
  for (const end = Date.now() + 60_000; Date.now() < end; await new Promise((go) => setTimeout(go, 250))) {
    if (await station.command(arm_disarm, [1]) === 0) return;
  }
  throw new Error("the vehicle does not let itself be armed");
}

const personalities = {
  rover: { plan: square(0), first: 0, make_ready: until_armed },
  px4: { plan: flight, first: 0, make_ready: async () => {} }, // arms on MISSION_START
  ardupilot: {
    // Its item 0 is home; behind a landing it would not say that the mission is complete.
    plan: [item(nav_waypoint, 0, 0, 0), ...flight.slice(0, -1), { ...item(nav_return, 0, 0, 0), frame: 0, x: 0, y: 0 }] /* which keeps no place of a return */,
    first: 1,
    async make_ready(station) {
      const guided = 4;
      check(await station.command(do_set_mode, [1, guided]) === 0, "GUIDED was refused");
      await until_armed(station);
    },
  },
};

function reached(station) {
  const all = station.heard.filter(({ name }) => name === "MISSION_ITEM_REACHED").map(({ message }) => message.seq);
  return all.filter((seq, n) => n === 0 || all[n - 1] !== seq); // some autopilots repeat themselves
}

async function fly(station, { plan, first, make_ready }) {
  check(await station.wait_for(["HEARTBEAT"], undefined, undefined, 0), "no heartbeat is heard");
  check(await station.upload(plan) === 0, "the upload was refused");
  compare(plan, await station.download(), first);
  await make_ready(station);
  check(await station.command(mission_start) === 0, "MISSION_START was refused");
  const is_complete = (message) => message.missionState === state_complete;
  check(await station.wait_for(["MISSION_CURRENT"], is_complete, 120_000), "the mission is not completed");
  const waypoints = plan.map((each, seq) => ({ ...each, seq })).filter(({ command, seq }) =>
    command === nav_waypoint && seq >= first).map(({ seq }) => seq);
  const in_order = reached(station);
  check(in_order.every((seq, n) => n === 0 || in_order[n - 1] < seq), `reached in the order ${in_order}`);
  check(waypoints.every((seq) => in_order.includes(seq)), `of ${waypoints} only ${in_order} were reached`);
  const currents = station.heard.filter(({ name }) => name === "MISSION_CURRENT").map(({ message }) => message.seq);
  check(waypoints.every((seq) => currents.includes(seq)), `of ${waypoints} some were never current: ${currents}`);
  compare(plan, await station.download(), first);
  return in_order;
}

async function run(program_path, name) {
  const definitions = await load_definitions();
  await with_vehicle(program_path, { personality: name }, async ([port], program) => {
    const station = new ground_station(port, definitions);
    program.stdout.on("data", (text) => process.stdout.write(text)); // for whoever reads why it failed
    try {
      const began = Date.now();
      const in_order = await fly(station, personalities[name]);
      console.log(`${name}: uploaded, flown and read back in ${Date.now() - began} ms; reached ${in_order}`);
    } finally {
      station.close();
    }
  });
}

const [program_path, name] = process.argv.slice(2);
if (!Object.hasOwn(personalities, name ?? "")) {
  console.error("usage: mission_check.mjs GODWIT_SIM rover|px4|ardupilot");
  process.exit(2);
}
try {
  await run(program_path, name);
} catch (error) {
  console.error(`ERROR: ${error.message}`);
  process.exitCode = 1;
}
