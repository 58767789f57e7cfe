// ./dev demo --page, flown to its end with a browser that looks at its page: a replan by the service, a crash of an actor
// and a kill of godwitd are on the way, and what the page shows at the end is how it ended.
//
//   GODWITD=... node --test demo_test.mjs
//
// The world runs several times as fast as in the demo. With GODWIT_PICTURES=FOLDER the pictures that README shows are
// taken of this flight and written there; with GODWIT_FILM=FOLDER a picture of it each quarter of a second, with what
// the demo prints below it:
//
//   ffmpeg -framerate 8 -i FOLDER/%04d.png -vf scale=800:-1 -quality 55 -loop 0 docs/pictures/demo.webp
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { after, test } from "node:test";
import { load, root, soon, until, wait } from "./flight_world.mjs";

const speed = 6;
const ready_ms = 60_000; // for all programs to be there; and from there to flying: fetch, checks, upload
const flight_ms = 240_000; // 70 s on a machine that has nothing else to do
let heard = "";
let browser;
const demo = spawn(join(root, "scripts/demo"), ["--page", "--speed", String(speed), "--bin", dirname(process.env.GODWITD)],
  { stdio: ["ignore", "pipe", "pipe"] });
for (const out of [demo.stdout, demo.stderr]) out.on("data", (some) => { heard += some; });
const ended = new Promise((then) => demo.once("exit", then));
after(async () => {
  await browser?.close();
  if (demo.exitCode === null) demo.kill("SIGTERM");
  await ended;
});

async function picture(page, name, theme, tab, size) {
  await page.setViewportSize(size);
  await page.click(`#theme-${theme}`);
  await page.click(`#tab-${tab}`);
  await wait(500);
  await page.evaluate("document.querySelectorAll('#alarms button').forEach((each) => each.click())");
  await page.click("#see-all");
  await page.evaluate("window.scrollTo(0, 0)");
  await wait(300);
  writeFileSync(join(process.env.GODWIT_PICTURES, `page_${name}.png`), await page.screenshot());
}

// Until the flight is over.
async function film(page) {
  await page.setViewportSize({ width: 1280, height: 840 });
  await page.evaluate(() => {
    const words = document.createElement("pre");
    words.id = "words";
    words.style = "position:fixed;bottom:0;left:0;right:0;margin:0;padding:8px 16px;height:84px;overflow:hidden;" +
      "background:#14181b;color:#d8e0d8;font:15px/22px monospace;z-index:99";
    document.body.append(words);
  });
  for (let number = 0; !heard.includes("the flight is over"); number += 1) {
    const lines = heard.split("\n").filter((line) => line.trim() !== "").slice(-3).join("\n");
    await page.evaluate((text) => { document.querySelector("#words").textContent = text; }, lines);
    const name = `${String(number).padStart(4, "0")}.png`;
    writeFileSync(join(process.env.GODWIT_FILM, name), await page.screenshot());
    await wait(120);
  }
}

test("the page of the demo shows its end as it was", async () => {
  const [, address] = await until(() => /the page: (\S+)/.exec(heard), "the address of the page", () => heard, ready_ms);
  const { chromium } = load("playwright-core");
  browser = await chromium.launch({ executablePath: "/usr/bin/chromium-headless-shell", args: ["--no-sandbox", "--disable-gpu"] });
  const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
  const said = [];
  page.on("pageerror", (error) => said.push(String(error)));
  await page.goto(address);
  await page.waitForSelector("#me");
  const shows = async (where, words) => ((await page.textContent(where)) ?? "").includes(words);
  const all_heard = () => heard;
  await until(() => shows("#phase strong", "flying"), "it flies", all_heard, ready_ms);
  await until(() => shows("#authority strong", "godwit"), "godwit has the vehicle", all_heard);
  if (process.env.GODWIT_PICTURES) {
    const flown = async () => Number(/(\d+) of \d+ items/.exec(await page.textContent("#progress"))?.[1] ?? 0);
    await until(async () => (await flown()) >= 7, "seven items are flown", all_heard, flight_ms);
    await picture(page, "night", "night", "actors", { width: 1440, height: 900 });
    await picture(page, "sun", "sun", "plan", { width: 820, height: 1180 });
    await picture(page, "day", "day", "plots", { width: 1280, height: 800 });
    await page.click("#tab-plan");
  }
  if (process.env.GODWIT_FILM) await film(page);
  await until(() => heard.includes("the flight is over"), "the flight is over", all_heard, flight_ms);
  for (const [where, words] of [["#phase strong", "done"], ["#line", "live"], ["#authority strong", "nobody"]])
    await until(() => shows(where, words), `${words} in ${where}`, all_heard);
  await soon(async () => {
    const [, done, items] = /(\d+) of (\d+) items/.exec(await page.textContent("#progress"));
    assert.equal(done, items);
    assert.equal(await page.locator("#tab-body tr.done").count(), Number(items));
  });
  await page.click("#tab-missions");
  await soon(async () => {
    const missions = page.locator("#missions tbody tr");
    assert.equal(await missions.count(), 1);
    assert.match(await missions.first().textContent(), /complete.*missions service/s);
  });
  await until(async () => (await page.locator(".instrument.old").count()) === 0, "no value is old");
  await page.waitForSelector(".mark-vehicle:not(.old)");
  await page.click("#see-all");
  assert.deepEqual(said, []);
  assert.equal(await ended, 0, heard.slice(-2_000));
});
