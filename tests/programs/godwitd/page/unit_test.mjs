#!/usr/bin/env node
// The parts of the page that are pure, without a browser: types are checked, then model/*_test.ts run under node.
import { spawnSync } from "node:child_process";
import { mkdtempSync, readdirSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const page = join(here, "../../../../programs/godwitd/page");
const load = createRequire(join(page, "package.json"));
const folder = mkdtempSync(join(tmpdir(), "godwit-page-unit-"));

function run(...words) {
  const { status } = spawnSync(process.execPath, words, { stdio: "inherit", cwd: page });
  return status === 0;
}

const tests = readdirSync(join(here, "model")).filter((each) => each.endsWith("_test.ts"));
await load("esbuild").build({ entryPoints: tests.map((each) => join(here, "model", each)), bundle: true, platform: "node",
  format: "esm", outdir: folder, outExtension: { ".js": ".mjs" }, logLevel: "warning" });
const is_well = [run(join(page, "node_modules/typescript/bin/tsc"), "--noEmit", "--project", page),
  ...tests.map((each) => run("--test", join(folder, each.replace(/\.ts$/, ".mjs"))))].every((each) => each);
rmSync(folder, { recursive: true });
process.exit(is_well ? 0 : 1);
