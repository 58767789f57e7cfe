// A simulated vehicle, godwitd beside it, and browsers that look at its page: what the tests of the page begin with.
//
// Everything lives in a scratch folder and ends with `end()`. The vehicle's world runs SPEED times as fast; godwitd and
// the page run in real time. Programs come from GODWITD and GODWIT_SIM of the environment.
import assert from "node:assert/strict";
import { spawn, spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createConnection, createServer } from "node:net";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { setTimeout as wait } from "node:timers/promises";
import { fileURLToPath } from "node:url";

export const root = join(dirname(fileURLToPath(import.meta.url)), "../../../..");
export const page_folder = join(root, "programs/godwitd/page");
export const load = createRequire(join(page_folder, "package.json"));
export const password = "correct horse battery";
const patience_ms = 20_000;
const wide = { width: 1280, height: 800 };

function without_settings() {
  return Object.fromEntries(Object.entries(process.env).filter(([name]) => !name.startsWith("GODWIT_")));
}

// A program whose words are kept; says() waits for some of them.
class child {
  constructor(program, words) {
    this.heard = "";
    this.process = spawn(program, words.map(String), { stdio: ["ignore", "pipe", "pipe"], env: without_settings() });
    for (const out of [this.process.stdout, this.process.stderr]) out.on("data", (some) => { this.heard += some; });
    this.ended = new Promise((then) => this.process.once("exit", then));
  }

  async says(what) {
    return until(() => what.exec(this.heard), `${what} from ${this.process.spawnfile}`, () => this.heard.slice(-2_000));
  }

  async kill(signal = "SIGKILL") {
    if (this.process.exitCode === null && this.process.signalCode === null) this.process.kill(signal);
    await this.ended;
  }
}

export async function until(condition, what, more = () => "", within_ms = patience_ms) {
  for (const end = Date.now() + within_ms; Date.now() < end; await wait(20)) {
    const found = await condition();
    if (found) return found;
  }
  throw new Error(`it did not come: ${what}\n${more()}`);
}

// A page draws what it hears a moment later: CHECK is repeated until it throws nothing any more.
export async function soon(check, within_ms = patience_ms) {
  for (const end = Date.now() + within_ms; ; await wait(20)) {
    try {
      return await check();
    } catch (error) {
      if (Date.now() >= end) throw error;
    }
  }
}

export class flight_world {
  // MORE, VEHICLE_MORE: options of godwitd and of the vehicle. HAS_SERVICE: the mission comes from a missions service.
  constructor({ speed = 5, mission = join(root, "missions/survey.json"), more = [], vehicle_more = [], has_service = false } = {}) {
    this.folder = mkdtempSync(join(tmpdir(), "godwit-page-"));
    this.speed = speed;
    this.mission = mission;
    this.more = more;
    this.vehicle_more = vehicle_more;
    this.has_service = has_service;
  }

  async begin() {
    this.vehicle = new child(process.env.GODWIT_SIM, ["vehicle", "--personality", "px4", "--speed", this.speed, "--link",
      "udpin://127.0.0.1:0", "--control", "127.0.0.1:0", "--home", "47.397742,8.545594,488", ...this.vehicle_more]);
    this.vehicle_port = (await this.vehicle.says(/udpin:\/\/127\.0\.0\.1:(\d+)/))[1];
    this.sim_port = (await this.vehicle.says(/control port 127\.0\.0\.1:(\d+)/))[1];
    for (const [name, role] of [["anna", "operator"], ["bob", "engineer"], ["carl", "viewer"]])
      this.run("operator", "add", name, "--role", role, "--accounts", join(this.folder, "operators"));
    this.brings_mission = this.has_service ? await this.start_service() : ["--mission", this.mission];
    await this.start_daemon();
    return this;
  }

  // Returns the options with which godwitd has its mission from it.
  async start_service() {
    const token = join(this.folder, "token");
    writeFileSync(token, "token-of-the-tests\n", { mode: 0o600 });
    this.service = new child(process.env.GODWIT_SIM, ["missions", "--listen", "127.0.0.1:0", "--token-file", token, "--mission", this.mission,
      "--db", join(this.folder, "missions.db")]);
    const [, url] = await this.service.says(/listening on (http:\/\/\S+)/);
    return ["--service", url, "--token-file", token, "--mission-id", JSON.parse(readFileSync(this.mission, "utf8")).mission_id];
  }

  // One after the other: the one that was killed has its address.
  async start_daemon() {
    const listen = this.address ?? "127.0.0.1:0";
    this.daemon = new child(process.env.GODWITD, [...this.brings_mission, "--vehicle", `udpout://127.0.0.1:${this.vehicle_port}`,
      "--journal", join(this.folder, "godwit.db"), "--trace", join(this.folder, "trace"), "--accounts",
      join(this.folder, "operators"), "--operator-listen", listen, "--allow-crash", "--arm-on-start", ...this.more]);
    this.address = (await this.daemon.says(/what there is to see: http:\/\/([^/]+)\//))[1];
  }

  run(...words) {
    const done = spawnSync(process.env.GODWITD, words, { input: `${password}\n`, encoding: "utf8", env: without_settings() });
    if (done.status !== 0) throw new Error(`godwitd ${words.join(" ")}: ${done.stderr}`);
    return done.stdout.trim();
  }

  ctl(...words) {
    return this.run("ctl", ...words, "--journal", join(this.folder, "godwit.db"));
  }

  // A fault in the words of docs/godwit-sim.md.
  async vehicle_does(what) {
    const line = createConnection({ host: "127.0.0.1", port: Number(this.sim_port) });
    line.write(`${JSON.stringify({ do: what })}\n`);
    const answer = JSON.parse(await new Promise((then, fail) => line.once("data", (some) => then(String(some))).once("error", fail)));
    line.end();
    if (!answer.ok) throw new Error(`${what}: ${answer.error}`);
    return answer;
  }

  // NAME: of the host, as in the address bar; another one than 127.0.0.1 is no secure context.
  async open_browser({ name = "127.0.0.1", size = wide } = {}) {
    const { chromium } = load("playwright-core");
    this.browser ??= await chromium.launch({ executablePath: "/usr/bin/chromium-headless-shell",
      args: ["--no-sandbox", "--disable-gpu", "--host-resolver-rules=MAP drone.local 127.0.0.1"] });
    const context = await this.browser.newContext({ viewport: size });
    const page = await context.newPage();
    page.said = [];
    page.asked_elsewhere = [];
    page.on("console", (line) => line.type() === "error" && page.said.push(line.text()));
    page.on("pageerror", (error) => page.said.push(String(error)));
    page.on("dialog", (shown) => {
      page.said.push(`a dialog: ${shown.message()}`); // of a script that came as a name
      void shown.dismiss();
    });
    page.on("request", (asked) => new URL(asked.url()).hostname === name || asked.url().startsWith("data:") ||
      page.asked_elsewhere.push(asked.url()));
    page.address = `http://${name}:${this.address.split(":")[1]}/`;
    await page.goto(page.address);
    return page;
  }

  // Debian's Firefox, over WebDriver BiDi: Playwright drives only its own. The page has those of Playwright's words that
  // log_in(), hold() and value_of() say.
  async open_firefox({ size = wide } = {}) {
    const puppeteer = load("puppeteer-core");
    this.firefox ??= await puppeteer.launch({ browser: "firefox", protocol: "webDriverBiDi", executablePath: "/usr/bin/firefox-esr",
      headless: true, userDataDir: join(this.folder, "firefox"), env: { ...process.env, HOME: this.folder } });
    const page = await this.firefox.newPage();
    await page.setViewport(size);
    page.said = [];
    page.asked_elsewhere = [];
    page.on("console", (line) => line.type() === "error" && page.said.push(line.text()));
    page.on("pageerror", (error) => page.said.push(String(error)));
    page.on("request", (asked) => new URL(asked.url()).hostname === "127.0.0.1" || asked.url().startsWith("data:") ||
      page.asked_elsewhere.push(asked.url()));
    page.textContent = async (where) => (await page.waitForSelector(where)).evaluate((found) => found.textContent);
    page.fill = async (where, words) => (await page.waitForSelector(where)).type(words);
    await page.goto(`http://${this.address}/`);
    return page;
  }

  async log_in(page, name = "anna") {
    await page.click("#show-login");
    await page.fill("input[name=name]", name);
    await page.fill("input[name=password]", password);
    await page.click(".login button[type=submit]");
    await page.waitForSelector("#me");
  }

  async end() {
    await this.browser?.close();
    await this.firefox?.close();
    await this.daemon?.kill("SIGTERM");
    await this.vehicle?.kill();
    await this.service?.kill();
    rmSync(this.folder, { recursive: true, force: true });
  }
}

export async function free_port() {
  const server = createServer();
  await new Promise((then) => server.listen(0, "127.0.0.1", then));
  const { port } = server.address();
  await new Promise((then) => server.close(then));
  return port;
}

// Of an instrument.
export async function value_of(page, name) {
  return page.textContent(`[data-value=${name}] .value`);
}

// Presses BUTTON and holds it until the page has acted on it. A press that a moved layout or a late timer ended earlier
// did nothing: it is repeated, as a person would. PRESS and RELEASE: by pointer where not given.
export async function hold(page, button, press = () => page.mouse.down(), release = () => page.mouse.up()) {
  await soon(async () => {
    await page.waitForSelector(`${button}:not([disabled])`);
    await page.hover(button);
    const watch = await page.evaluateHandle(watch_hold, button);
    await press();
    const is_done = await watch.evaluate((each) => each.acted);
    await release();
    assert.ok(is_done, `${button} was let go`);
  });
}

// In the browser: `acted` becomes true when the hold of BUTTON has lasted, false when an event ended it or none began.
function watch_hold(button) {
  const held = document.querySelector(button);
  const acted = new Promise((then) => {
    if (held === null) return then(false);
    for (const end of ["pointerleave", "pointercancel", "blur"])
      document.addEventListener(end, (event) => event.target === held && then(false), { capture: true });
    let begun = false;
    new MutationObserver(() => {
      if (held.classList.contains("holding")) begun = true;
      else if (begun) then(true);
    }).observe(held, { attributeFilter: ["class"] });
    setTimeout(() => begun || then(false), 2_000);
  });
  return { acted };
}

export { wait };
