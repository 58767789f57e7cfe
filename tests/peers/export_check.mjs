#!/usr/bin/env node
// Opens what godwit-trace exports with readers that are not ours, and says whether it is what it claims.
//
//   node export_check.mjs GODWIT_TRACE TRACE
//
// html      Chromium shows the page: title, way of the vehicle and time line are there, nothing is asked of any host
// mermaid   Mermaid draws the sequence in Chromium, with an arrow for each message of ours
// perfetto  each event as the Chrome trace event format has it; each arrow has its begin and its end
//
// TRACE: a folder of a flight that was recorded. Prints a line a format; exit 1 when one is not as it should be.
import { execFileSync, spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const mermaid_script = join(here, "node_modules/mermaid/dist/mermaid.min.js");
const browser = "chromium-headless-shell";
const most_bytes = 256 * 1024 * 1024;

const [program, trace] = process.argv.slice(2);
if (trace === undefined) {
  console.error("usage: export_check.mjs GODWIT_TRACE TRACE");
  process.exit(2);
}
const folder = mkdtempSync(join(tmpdir(), "godwit-exports-"));
const flaws = [];
const require_that = (holds, sentence) => holds || flaws.push(sentence);

function exported(format, ...more) {
  return execFileSync(program, ["export", trace, "--format", format, ...more], { maxBuffer: most_bytes,
    encoding: "utf8", stdio: ["ignore", "pipe", "ignore"] });
}

// The page as it is when its scripts have run, and what the browser said beside it.
function shown(page) {
  const result = spawnSync(browser, ["--no-sandbox", "--disable-gpu", "--enable-logging=stderr", "--v=0",
    "--allow-file-access-from-files", `--user-data-dir=${join(folder, "profile")}`, "--virtual-time-budget=60000",
    "--dump-dom", pathToFileURL(page).href], { encoding: "utf8", maxBuffer: most_bytes, timeout: 120_000 });
  if (result.error?.code === "ENOENT") {
    console.error(`export_check: ${browser} is not installed; run ./dev test, which installs it.`);
    process.exit(1);
  }
  require_that(result.status === 0, `the browser ended with ${result.status ?? result.signal}: ${result.stderr}`);
  return { dom: result.stdout, console: result.stderr.split("\n").filter((line) => line.includes(":CONSOLE")) };
}

function check_html() {
  const text = exported("html");
  const page = join(folder, "report.html");
  writeFileSync(page, text);
  const { dom, console: said } = shown(page);
  require_that(!/(?:src|href)=|url\(|@import|<script/i.test(text), "the page asks for something, or has a script");
  require_that(dom.includes("<h1>Flight report</h1>"), "the page has no title");
  require_that(/<polyline[^>]*points="[0-9. ,-]{20,}"/.test(dom), "the page does not show the way of the vehicle");
  const rows = dom.match(/<tr/g)?.length ?? 0;
  require_that(rows > 20, `the page has ${rows} rows`);
  require_that(said.length === 0, `the browser complains: ${said.join("; ")}`);
  return `${rows} rows`;
}

function check_mermaid() {
  const text = exported("mermaid");
  const arrows = text.split("\n").filter((line) => line.includes("->>")).length;
  const page = join(folder, "sequence.html");
  writeFileSync(page, `<!doctype html><meta charset="utf-8"><body><script>${readFileSync(mermaid_script, "utf8")
    .replaceAll("</script", "<\\/script")}</script><script>
    const draw = async () => {
      mermaid.initialize({ startOnLoad: false, maxTextSize: 10000000, maxEdges: 100000 });
      const { svg } = await mermaid.render("drawn", ${JSON.stringify(text)});
      document.body.innerHTML = "<p id=state>drawn</p>" + svg;
    };
    draw().catch((error) => { document.body.innerHTML = "<p id=state></p>"; document.body.firstChild.textContent = error; });
    </script>`);
  const { dom } = shown(page);
  const state = /<p id="?state"?>([^<]*)/.exec(dom)?.[1] ?? "nothing was drawn";
  require_that(state === "drawn", `Mermaid says: ${state}`);
  const drawn = dom.match(/class="messageLine[01]"/g)?.length ?? 0;
  require_that(arrows > 0 && drawn === arrows, `Mermaid drew ${drawn} of ${arrows} messages`);
  return `${drawn} messages`;
}

// https://docs.google.com/document/d/1CvAClvFfyA5R-PhYUmn5OOQtYMH4h6I0nSsKchNAySU (Trace Event Format)
function check_perfetto() {
  const { traceEvents: events } = JSON.parse(exported("perfetto"));
  const begun = new Map();
  let slices = 0;
  let ended = 0;
  for (const each of events) {
    const has_place = Number.isInteger(each.pid) && Number.isInteger(each.tid);
    require_that(flaws.length > 20 || has_place, `no pid or tid: ${JSON.stringify(each)}`);
    if (each.ph !== "M") require_that(flaws.length > 20 || Number.isFinite(each.ts), `no ts: ${JSON.stringify(each)}`);
    if (each.ph === "X") {
      slices += 1;
      require_that(flaws.length > 20 || (each.dur >= 0 && each.name !== ""), `no slice: ${JSON.stringify(each)}`);
    } else if (each.ph === "s") {
      begun.set(each.id, each.ts);
    } else if (each.ph === "f") {
      ended += 1;
      require_that(flaws.length > 20 || begun.get(each.id) <= each.ts, `an arrow without its begin: ${JSON.stringify(each)}`);
    } else {
      require_that(flaws.length > 20 || "MiCt".includes(each.ph), `a phase of no event: ${JSON.stringify(each)}`);
    }
  }
  require_that(slices > 100 && ended > 100, `${slices} slices, ${ended} arrows`);
  require_that(ended === begun.size, `${begun.size} arrows begin, ${ended} end`);
  return `${slices} slices, ${ended} arrows`;
}

for (const [format, check] of Object.entries({ html: check_html, mermaid: check_mermaid, perfetto: check_perfetto })) {
  const before = flaws.length;
  const found = check();
  console.log(flaws.length === before ? `${format}: ${found}` : `ERROR: ${format}: ${flaws.slice(before).join("\n  ")}`);
}
rmSync(folder, { recursive: true, force: true });
process.exit(flaws.length === 0 ? 0 : 1);
