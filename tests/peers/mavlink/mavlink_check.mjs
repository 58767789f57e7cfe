#!/usr/bin/env node
// The other side of the peer check: node-mavlink, an implementation of MAVLink that is not ours.
//
//   node mavlink_check.mjs read FRAMES LINES            holds our frames against the descriptions that we wrote
//   node mavlink_check.mjs self-test FRAMES LINES       changes each field and each byte of these: each must be noticed
//   node mavlink_check.mjs write FOLDER LINES [SEED]    frames of the messages that are named in LINES
//
// Exit 0 if all is as it must be, 1 if not, 2 on wrong usage.
import { readFileSync } from "node:fs";

import { load_definitions } from "./definitions.mjs";
import { read_frames } from "./read_frames.mjs";
import { write_theirs } from "./write_theirs.mjs";

const default_seed = 1;
const max_printed = 20; // differences; the rest is counted
const min_frame_size = 12;
const signature_size = 13;

const load_lines = (path) => readFileSync(path, "utf8").trimEnd().split("\n").map((line) => JSON.parse(line));

function compare(prefix, expected, found) {
  const wrong = [];
  for (const [name, text] of Object.entries(expected)) {
    if (!Object.hasOwn(found, name)) wrong.push(`${prefix}${name}: missing, expected ${text}`);
    else if (found[name] !== text) wrong.push(`${prefix}${name}: ${found[name]}, expected ${text}`);
  }
  for (const name of Object.keys(found)) {
    if (!Object.hasOwn(expected, name)) wrong.push(`${prefix}${name}: ${found[name]}, expected nothing of this name`);
  }
  return wrong;
}

function differences(expected, found) {
  return [...compare("", { message: expected.message }, { message: found.message }),
    ...compare(`${expected.message} `, expected.frame, found.frame),
    ...compare(`${expected.message}.`, expected.fields, found.fields)];
}

function all_differences(expected, found) {
  const wrong = expected.length === found.length ? [] : [`${found.length} frames, expected ${expected.length}`];
  for (let i = 0; i < Math.min(expected.length, found.length); ++i) {
    wrong.push(...differences(expected[i], found[i]).map((each) => `frame ${i}: ${each}`));
  }
  return wrong;
}

// Each message must be there, signed and unsigned: what is not, was not compared.
function uncovered(expected) {
  const covered = new Set(expected.map((each) => `${each.message} ${each.frame.signature}`));
  const messages = [...new Set(expected.map((each) => each.message))];
  const wanted = messages.flatMap((name) => [`${name} none`, `${name} right`]);
  return wanted.filter((each) => !covered.has(each)).map((each) => `${each}: no frame with such a signature`);
}

function summary(frames) {
  const messages = new Set(frames.map((each) => each.message)).size;
  const with_signature = frames.filter((each) => Object.hasOwn(each.frame, "link")).length;
  const fields = frames.reduce((sum, each) => sum + Object.keys(each.fields).length, 0);
  return `${frames.length} frames of ${messages} messages, ${with_signature} signed, ${fields} fields`;
}

function report(what, good, wrong) {
  for (const each of wrong.slice(0, max_printed)) console.log(each);
  console.log(`${what}: ${wrong.length === 0 ? good : `ERROR: ${wrong.length} wrong`}`);
  return wrong.length === 0 ? 0 : 1;
}

// node-mavlink drops what it does not know without a word, so that is looked for first.
function undefined_messages(expected, classes) {
  const names = expected.filter((each) => !classes[each.frame.id]).map((each) => `${each.message} (${each.frame.id})`);
  return [...new Set(names)].map((name) => `${name} is not in node-mavlink: see \`lacking\` in definitions.mjs`);
}

async function read(definitions, frames, lines) {
  const expected = load_lines(lines);
  const found = await read_frames(readFileSync(frames), definitions);
  return report(`read ${summary(expected)}`, "all equal", [...undefined_messages(expected, definitions.classes),
    ...all_differences(expected, found), ...uncovered(expected)]);
}

// A description in which one text was changed must differ in exactly that.
function change_each_text(right, part, unnoticed) {
  const names = Object.keys(right[part]);
  for (const name of names) {
    const changed = structuredClone(right);
    changed[part][name] += "0";
    if (differences(changed, right).length !== 1) {
      unnoticed.push(`${right.message} ${name}: the change was not noticed`);
    }
  }
  return names.length;
}

// A frame in which one bit was changed must not be read as it was.
async function change_each_byte(definitions, frame, right, unnoticed) {
  for (let i = 0; i < frame.length; ++i) {
    const changed = Buffer.from(frame);
    changed[i] ^= 1 << i % 8;
    if (all_differences([right], await read_frames(changed, definitions)).length === 0) {
      unnoticed.push(`${right.message}: the change of byte ${i} was not noticed`);
    }
  }
  return frame.length;
}

// Of the frame at the beginning of REST: header, payload and checksum, and the signature if it has one.
const frame_size = (rest) => min_frame_size + rest[1] + (rest[2] & 1 ? signature_size : 0);

async function self_test(definitions, frames, lines) {
  const unnoticed = [];
  let texts_changed = 0;
  let bytes_changed = 0;
  let rest = readFileSync(frames);
  for (const right of load_lines(lines)) {
    const frame = rest.subarray(0, frame_size(rest));
    texts_changed += change_each_text(right, "frame", unnoticed) + change_each_text(right, "fields", unnoticed);
    bytes_changed += await change_each_byte(definitions, frame, right, unnoticed);
    rest = rest.subarray(frame.length);
  }
  const what = `self-test: ${texts_changed} texts and ${bytes_changed} bytes changed, one at a time`;
  return report(what, "all noticed", unnoticed);
}

// Those that we have written are those that the peer must write: the list is ours, and stands in one place.
function write({ classes }, folder, lines, seed) {
  const ours = load_lines(lines);
  const ids = [...new Set(ours.map((each) => each.frame.id))].filter((id) => classes[id]);
  const written = write_theirs(folder, ids.map((id) => classes[id]), seed);
  const what = `written with seed ${seed}: ${summary(written)}`;
  return report(what, "all that we have", undefined_messages(ours, classes));
}

async function run([command, first, second, seed]) {
  if (second !== undefined && (command === "read" || command === "self-test") && seed === undefined) {
    return (command === "read" ? read : self_test)(await load_definitions(), first, second);
  }
  if (command === "write" && second !== undefined && /^\d+$/.test(seed ?? "0")) {
    return write(await load_definitions(), first, second, Number(seed ?? default_seed));
  }
  console.error("usage: node mavlink_check.mjs read FRAMES LINES | self-test FRAMES LINES | write FOLDER LINES [SEED]");
  return 2;
}

try {
  process.exitCode = await run(process.argv.slice(2));
} catch (error) {
  console.error(`mavlink_check: ${error.message}`);
  process.exitCode = 1;
}
