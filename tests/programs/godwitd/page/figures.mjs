// How heavy and how quick the page is, as ./dev bench page prints it:
//
//   weight         bytes of the first load, gzip
//   first position from the opening of the page, with a session, until the vehicle is on the map; also at 1 Mbit/s, 100 ms (slow_line.mjs)
//   latency        from the time that a position has in the stream until the page shows it, 10 a second
//   crash          of an actor, until its row says so
//   main thread    share of a core (processor time), with 1,000 items and a track of two hours, at 10 positions a second
//   heap           growth over 72,000 positions, behind a garbage collection
//   daemon killed  until the page says so, and from the next start until it is live again
//
// The last two feed the page from a WebSocket that is made in the page; the rest is a godwitd with a simulated vehicle.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { gzipSync } from "node:zlib";
import { flight_world, hold, page_folder, until, value_of, wait } from "./flight_world.mjs";
import { slow_line } from "./slow_line.mjs";

const line = (name, words) => console.log(`${name.padEnd(32)}${words}`);
const quantile = (sorted, share) => sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))];

function print_weight() {
  const files = ["icon.svg", "index.html", "page.css", "page.js"];
  const bytes = files.reduce((sum, each) => sum + gzipSync(readFileSync(join(page_folder, "built", each)), { level: 9 }).length, 0);
  line("weight", `${(bytes / 1000).toFixed(1)} kB gzip`);
}

// Milliseconds from the navigation until the vehicle is drawn.
async function first_position(page) {
  await page.goto("about:blank");
  await page.goto(page.address, { waitUntil: "commit" });
  await page.waitForSelector(".mark-vehicle");
  return page.evaluate("window.vehicle_seen_at");
}

function note_vehicle() {
  new MutationObserver((_, all) => {
    if (document.querySelector(".mark-vehicle") === null) return;
    window.vehicle_seen_at = performance.now();
    all.disconnect();
  }).observe(document, { childList: true, subtree: true });
}

async function print_first_position(world, page) {
  await page.addInitScript(note_vehicle);
  const times = [];
  for (let i = 0; i < 7; ++i) times.push(await first_position(page));
  line("first position, loopback", `${Math.round(quantile(times.sort((a, b) => a - b), 0.5))} ms, median of 7; most ${Math.round(times.at(-1))} ms`);
  const line_to = await slow_line(world.address, { bytes_a_second: 125_000, round_trip_ms: 100 });
  const slow = [];
  await page.goto("about:blank"); // godwitd has eight places for one computer
  await wait(500);
  for (let i = 0; i < 5; ++i) {
    // With the session, and nothing else of what the browser has kept: files of another port are other files.
    const context = await world.browser.newContext({ storageState: await page.context().storageState() });
    const fresh = await context.newPage();
    await fresh.addInitScript(note_vehicle);
    fresh.address = `http://${line_to.address}/`;
    slow.push(await first_position(fresh));
    await context.close();
    await wait(500);
  }
  line_to.end();
  slow.sort((a, b) => a - b);
  line("first position, 1 Mbit/s 100 ms", `${Math.round(quantile(slow, 0.5))} ms, median of 5; most ${Math.round(slow.at(-1))} ms; nothing kept by the browser`);
}

async function print_latency(world) {
  const page = await world.open_browser();
  await page.close();
  const context = await world.browser.newContext();
  const measured = await context.newPage();
  await measured.addInitScript(() => {
    window.delays_ms = [];
    const told = window.WebSocket;
    let newest;
    window.WebSocket = class extends told {
      constructor(...words) {
        super(...words);
        this.addEventListener("message", (event) => {
          const said = JSON.parse(event.data);
          if (said.topic === "position") newest = said.at_ms;
        });
      }
    };
    document.addEventListener("DOMContentLoaded", () => new MutationObserver(() => {
      if (newest === undefined) return;
      window.delays_ms.push(Date.now() - newest);
      newest = undefined;
    }).observe(document.getElementById("page"), { childList: true, subtree: true, characterData: true, attributes: true }));
  });
  await measured.goto(page.address);
  const began = Date.now();
  await measured.waitForFunction(() => window.delays_ms.length >= 110, undefined, { timeout: 60_000 });
  const rate = 110_000 / (Date.now() - began);
  const delays = (await measured.evaluate("window.delays_ms")).slice(10).sort((a, b) => a - b);
  line("latency", `median ${quantile(delays, 0.5)} ms, p99 ${quantile(delays, 0.99)} ms, most ${delays.at(-1)} ms, of ${delays.length} positions, ${rate.toFixed(1)} a second`);
  await context.close();
}

// From the order to crash an actor, given at the control socket, until its row is red, or it is back already. How long it
// is away grows from crash to crash.
async function print_crash(world) {
  const page = await world.open_browser();
  await page.click("#tab-actors");
  const times = [];
  for (let i = 2; i < 6; ++i) {
    await page.waitForSelector('[data-actor="sightings"]');
    await wait(1_300); // at another moment of the second each time
    const began = Date.now();
    world.ctl("crash", "sightings");
    await page.waitForFunction((wanted) => {
      const row = document.querySelector('[data-actor="sightings"]');
      return row?.classList.contains("bad") || row?.textContent.includes(wanted);
    }, `incarnation ${i}`);
    times.push(Date.now() - began);
    await page.waitForFunction((wanted) => document.querySelector('[data-actor="sightings"]')?.textContent.includes(wanted), `incarnation ${i}`);
  }
  line("crash of an actor", `${times.join(", ")} ms until its row says so`);
  await page.close();
}

// From the kill of the daemon until the page says so, and from its next start until the page is live again.
async function print_kill(world) {
  const page = await world.open_browser();
  const is_live = (wanted) => page.waitForFunction((live) => (document.getElementById("line")?.textContent === "live") === live, wanted);
  const [said, back] = [[], []];
  for (let i = 0; i < 3; ++i) {
    await is_live(true);
    await wait(2_000 + 300 * i);
    const killed_at = Date.now();
    await world.daemon.kill();
    await is_live(false);
    said.push(Date.now() - killed_at);
    await world.start_daemon();
    const started_at = Date.now();
    await is_live(true);
    back.push(Date.now() - started_at);
  }
  line("daemon killed", `said within ${said.join(", ")} ms; back ${back.join(", ")} ms behind the start`);
  await page.close();
}

// A mission of a thousand places, and a stream that the test speaks.
function fed_by_test() {
  const place = (i) => ({ latitude: 47.4 + 0.0004 * Math.floor(i / 40), longitude: 8.5 + 0.0004 * (i % 40), altitude_m: 30 });
  window.plan = { generation: 1, home: null, kept: null, way: [...Array(1000).keys()].map(place), mission: { mission_id: "m", revision: 1, geofences: [],
    return_point: place(0), items: [...Array(1000).keys()].map((i) => ({ id: `w${i}`, kind: "waypoint", at: place(i) })) } };
  const asked = window.fetch;
  window.fetch = (path, more) => String(path).endsWith("/api/v1/plan") ? Promise.resolve(new Response(JSON.stringify(window.plan))) : asked(path, more);
  window.WebSocket = class {
    constructor() {
      window.line = this;
      setTimeout(() => this.onopen(), 0);
    }
    close() {}
  };
  let number = 0;
  let at_ms = 1_795_000_000_000;
  window.say = (topic, data) => window.line.onmessage({ data: JSON.stringify({ topic, number: ++number, at_ms, data }) });
  window.fly = (seconds) => {
    at_ms += 1000 * seconds;
    const t = number / 80;
    window.say("position", { latitude_deg: 47.41 + 0.008 * Math.sin(t / 7), longitude_deg: 8.51 + 0.01 * Math.cos(t / 11), altitude_m: 30 + Math.sin(t),
      altitude_msl_m: 500, ground_speed_mps: 5, climb_mps: 0, heading_deg: (t * 10) % 360 });
  };
}

async function print_load(world) {
  const context = await world.browser.newContext({ viewport: { width: 1280, height: 800 } });
  const page = await context.newPage();
  await page.addInitScript(fed_by_test);
  await page.goto(`http://${world.address}/`);
  await page.waitForFunction(() => window.line !== undefined);
  await wait(300);
  await page.evaluate(() => {
    window.line.onmessage({ data: JSON.stringify({ topic: "stream", data: { session: "1" } }) });
    window.say("flight", { phase: "flying", cause: "none", sentence: "", in_flight: true, is_armed: true, mode: "mission", preflight_report: 0, state: "" });
    window.say("progress", { mission_id: "m", revision: 1, generation: 1, items: 1000, items_done: 300, reports: 1 });
    window.say("clock", { beat: 1 });
    window.fly(0.1);
  });
  await wait(1_000);
  const devtools = await context.newCDPSession(page);
  await devtools.send("Performance.enable", { timeDomain: "threadTicks" }); // processor time
  const heap = async () => {
    await devtools.send("HeapProfiler.collectGarbage");
    return (await devtools.send("Runtime.getHeapUsage")).usedSize;
  };
  const before = await heap();
  await page.evaluate(async () => {
    for (let i = 0; i < 72_000; ++i) {
      window.fly(0.1);
      if (i % 10 === 0) window.say("clock", { beat: i });
      if (i % 500 === 0) await new Promise((then) => requestAnimationFrame(then));
    }
  });
  await wait(1_000);
  line("heap over 72,000 positions", `${((await heap() - before) / 1e6).toFixed(1)} MB more, of ${(before / 1e6).toFixed(1)} MB`);
  const busy = async () => (await devtools.send("Performance.getMetrics")).metrics.find((each) => each.name === "TaskDuration").value;
  const from = await busy();
  const began = Date.now();
  await page.evaluate(async () => {
    for (let i = 0; i < 150; ++i) {
      window.fly(0.1);
      if (i % 10 === 0) window.say("clock", { beat: i });
      await new Promise((then) => setTimeout(then, 100));
    }
  });
  const share = (await busy() - from) / ((Date.now() - began) / 1000);
  line("main thread", `${(100 * share).toFixed(1)} % of a core, 1,000 items, a track of 72,000 positions, ${Math.round(150 / ((Date.now() - began) / 1000))} positions a second`);
  await context.close();
}

print_weight();
const world = await new flight_world({ speed: 4 }).begin(); // so that its stream has ten positions a second
try {
  const page = await world.open_browser();
  await world.log_in(page);
  await until(async () => (await page.textContent("#phase")).includes("ready"), "ready");
  await page.click("#take-control");
  await hold(page, "#command-start");
  await until(async () => Number(await value_of(page, "Altitude")) > 5, "it flies");
  await print_first_position(world, page);
  await page.close();
  await print_latency(world);
  await print_crash(world);
  await print_load(world);
  await print_kill(world);
} finally {
  await world.end();
}
