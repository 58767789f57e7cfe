#!/usr/bin/env node
// node-mavlink as a ground station of godwitd, which flies the plan of the station with a simulated vehicle:
//
//   node station_check.mjs GODWIT_SIM GODWITD rover|px4|ardupilot
//
// Uploads a fence and a plan, reads the plan back, starts it, and follows it to its end in the numbers of its own plan;
// kills godwitd in the middle. Exit 0 if all is as it must be, 1 if not, 2 on wrong usage.
import { fly_with_daemon, main_of } from "./flying_daemon.mjs";
import { change_speed, check, compare, item, nav_return, nav_takeoff, square } from "./plans.mjs";

const mission_start = 300;
const fence_corner = 5001; // NAV_FENCE_POLYGON_VERTEX_INCLUSION
const fence_type = 1;
const accepted = 0;
const temporarily_rejected = 1;
const state_active = 3;
const state_complete = 5;

const side_m = 200; // so that each leg takes seconds, at twenty times real time
const flight = [item(nav_takeoff, 0, 0, 10), change_speed(5), ...square(10, side_m),
  { ...item(nav_return, 0, 0, 0), frame: 2 }];
const plans = { rover: [change_speed(5), ...square(0, side_m)], px4: flight, ardupilot: flight };

const fence = [[-300, -300], [-300, 300], [300, 300], [300, -300]].map((corner) =>
  ({ ...item(fence_corner, ...corner, 0), param1: 4 }));

// Refused for now means that the plan is still being checked, or brought to the vehicle.
async function start(station) {
  for (const end = Date.now() + 60_000; Date.now() < end; await new Promise((go) => setTimeout(go, 500))) {
    const result = await station.command(mission_start);
    if (result === accepted) return;
    check(result === temporarily_rejected, `MISSION_START is answered with ${result}`);
  }
  throw new Error("the mission can not be started within 60 s");
}

async function fly(station, plan, kill_daemon) {
  check(await station.wait_for(["HEARTBEAT"], undefined, undefined, 0), "no heartbeat of the vehicle is forwarded");
  check(await station.upload(fence, fence_type) === accepted, "the fence was refused");
  check(await station.upload(plan) === accepted, "the upload was refused");
  compare(plan, await station.download(), 0);
  await start(station);
  const before_kill = await station.wait_for(["MISSION_ITEM_REACHED"], ({ seq }) => seq >= 1);
  check(before_kill, "no item is reached");
  await kill_daemon();
  const is_complete = (message) => message.missionState === state_complete;
  check(await station.wait_for(["MISSION_CURRENT"], is_complete, 120_000), "the mission is not completed");
  const reached = station.heard.filter(({ name }) => name === "MISSION_ITEM_REACHED").map(({ message }) => message.seq);
  check(reached.every((seq, n) => n === 0 || reached[n - 1] < seq), `reached in the order ${reached}`);
  // The vehicle says it once: the item that it reaches while godwitd is dead is not told, and no autopilot tells a return.
  const may_miss = [before_kill.message.seq + 1, plan.length - 1];
  const missed = plan.map((_, seq) => seq).filter((seq) => !reached.includes(seq) && !may_miss.includes(seq));
  check(missed.length === 0, `of ${plan.length} items only ${reached} were told`);
  const active = station.heard.filter(({ name, message }) =>
    name === "MISSION_CURRENT" && message.missionState === state_active).map(({ message }) => message.seq);
  check(active.every((seq, n) => n === 0 || active[n - 1] <= seq), `current went back: ${active}`);
  check(active.at(-1) === plan.length - 1, `the last current item is ${active.at(-1)}`);
  return reached;
}

await main_of("station_check.mjs", Object.keys(plans), async (vehicle_path, daemon_path, name) => {
  const began = Date.now();
  const reached = await fly_with_daemon(vehicle_path, daemon_path, name, ["--arm-on-start"],
    (station, kill_daemon) => fly(station, plans[name], kill_daemon));
  console.log(`${name}: uploaded, flown and followed in ${Date.now() - began} ms; reached ${reached}`);
});
