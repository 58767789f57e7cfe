#!/usr/bin/env node
// Builds the page: src/ becomes built/, which is part of the repository and of the program.
//
//   node build.mjs            builds
//   node build.mjs --check    says what of built/ is not what src/ makes; exit 1
//
// The same sources and the same versions (package-lock.json) make the same bytes.
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";
import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const built = join(here, "built");
const bundled = ["leaflet", "lit", "lit-element", "lit-html", "@lit/reactive-element", "uplot"];
const files = ["icon.svg", "index.html", "notice.txt", "page.css", "page.js"];
const most_gzip_bytes = 150_000;

function notice() {
  const parts = bundled.map((name) => {
    const folder = join(here, "node_modules", name);
    const { version, license } = JSON.parse(readFileSync(join(folder, "package.json"), "utf8"));
    return `${name} ${version} (${license})\n\n${readFileSync(join(folder, "LICENSE"), "utf8").trim()}\n`;
  });
  return "The page of godwit is under Apache-2.0, as godwit is. It has these inside:\n\n" + parts.join(`\n${"-".repeat(80)}\n\n`);
}

async function make(folder) {
  mkdirSync(folder, { recursive: true });
  const shared = { bundle: true, minify: true, legalComments: "none", target: ["chrome109", "firefox115", "safari16.4"],
    absWorkingDir: here, logLevel: "warning" };
  await build({ ...shared, entryPoints: ["src/main.ts"], format: "esm", outfile: join(folder, "page.js") });
  await build({ ...shared, entryPoints: ["src/style.css"], outfile: join(folder, "page.css"), loader: { ".png": "empty" } });
  for (const name of ["icon.svg", "index.html"]) writeFileSync(join(folder, name), readFileSync(join(here, "src", name)));
  writeFileSync(join(folder, "notice.txt"), notice());
}

function weigh(folder) {
  const loaded = files.filter((each) => each !== "notice.txt");
  const bytes = loaded.reduce((sum, each) => sum + gzipSync(readFileSync(join(folder, each)), { level: 9 }).length, 0);
  console.log(`page: ${bytes} bytes gzip at the first load, of at most ${most_gzip_bytes}`);
  return bytes <= most_gzip_bytes;
}

let is_well = true;
if (process.argv[2] === "--check") {
  const folder = mkdtempSync(join(tmpdir(), "godwit-page-"));
  await make(folder);
  for (const each of files)
    if (!readFileSync(join(folder, each)).equals(readFileSync(join(built, each)))) {
      console.error(`page: built/${each} is not what src/ makes; run ./dev page`);
      is_well = false;
    }
  rmSync(folder, { recursive: true });
} else {
  await make(built);
}
process.exit(weigh(built) && is_well ? 0 : 1);
