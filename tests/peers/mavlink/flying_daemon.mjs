// A simulated vehicle, godwitd beside it, and node-mavlink as the ground station of both.
import { spawn } from "node:child_process";
import { createSocket } from "node:dgram";
import { once } from "node:events";
import { mkdtemp, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";

import { load_definitions } from "./definitions.mjs";
import { end, ground_station, ports_of } from "./ground_station.mjs";
import { home_text } from "./plans.mjs";

const speed = "20"; // times real time

export async function free_port() {
  const socket = createSocket("udp4");
  socket.bind(0, "127.0.0.1");
  await once(socket, "listening");
  const { port } = socket.address();
  socket.close();
  return port;
}

// Calls USE with the ports of a vehicle that begins at HOME and is reached on so many LINES; ends it behind that.
export async function with_vehicle(vehicle_path, { personality, home = home_text, lines = 1 }, use) {
  const links = Array.from({ length: lines }, () => ["--link", "udpin://127.0.0.1:0"]).flat();
  const vehicle = spawn(vehicle_path, ["vehicle", "--personality", personality, ...links, "--home", home, "--speed",
    speed], { stdio: ["ignore", "pipe", "inherit"] });
  vehicle.stdout.setEncoding("utf8");
  try {
    return await use(await ports_of(vehicle, lines), vehicle);
  } finally {
    await end(vehicle);
  }
}

// Calls FLY with the station and what kills the daemon and starts it again; ends all of them behind it.
export async function fly_with_daemon(vehicle_path, daemon_path, personality, options, fly) {
  const definitions = await load_definitions();
  const folder = await mkdtemp(join(tmpdir(), "godwit-station-"));
  const ground = await free_port();
  try {
    return await with_vehicle(vehicle_path, { personality }, async ([port]) => {
      let daemon, station;
      const start_daemon = () => {
        daemon = spawn(daemon_path, ["--vehicle", `udpout://127.0.0.1:${port}`, "--ground",
          `udpin://127.0.0.1:${ground}`, ...options, "--journal", join(folder, "godwit.db"), "--trace",
          join(folder, "trace")], { stdio: ["ignore", "inherit", "inherit"] });
      };
      start_daemon();
      try {
        station = new ground_station(ground, definitions);
        return await fly(station, async () => {
          daemon.kill("SIGKILL");
          await once(daemon, "exit");
          start_daemon();
        });
      } finally {
        station?.close();
        await end(daemon);
      }
    });
  } finally {
    await rm(folder, { recursive: true });
  }
}

// PROGRAM GODWIT_SIM GODWITD NAME, where NAMES has NAME; how RUN fails is how the program does.
export async function main_of(program, names, run) {
  const [vehicle_path, daemon_path, ...name] = process.argv.slice(2);
  if (!names.includes(name.join(" "))) {
    console.error(`usage: ${program} GODWIT_SIM GODWITD ${names.join("|")}`);
    process.exitCode = 2;
    return;
  }
  try {
    await run(vehicle_path, daemon_path, ...name);
  } catch (error) {
    console.error(`ERROR: ${error.message}`);
    process.exitCode = 1;
  }
}
