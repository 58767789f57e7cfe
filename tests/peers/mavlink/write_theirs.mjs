// Writes frames of node-mavlink for us to read, unsigned and signed, and beside them what we must find.
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";

import { mavlink } from "./definitions.mjs";
import { texts_of } from "./field_text.mjs";
import { byte_patterns, patterned, random_numbers, randomised } from "./field_values.mjs";
import { test_key } from "./read_frames.mjs";

const random_frames = 25; // of each message, and as many signed ones
const senders = [[1, 1], [255, 190], [42, 0], [254, 255]]; // system and component
const link = 3;
const signing_ms = 1_781_000_000_000; // a day in 2026, in our program too
const units_per_ms = 100; // of the time in a signature

function describe(message, sequence, [system, component], time) {
  const is_signed = time !== undefined;
  const frame = { id: String(message.constructor.MSG_ID), sequence: String(sequence), system: String(system),
    component: String(component), signature: is_signed ? "right" : "none" };
  const words = is_signed ? { ...frame, link: String(link), time: String(time) } : frame;
  return { message: message.constructor.MSG_NAME, frame: words, fields: texts_of(message) };
}

// Gives each message the next sequence number and, when it is signed, the next millisecond.
class frame_writer {
  frames = [];
  descriptions = [];
  #signed = 0;
  #random;
  constructor(random) {
    this.#random = random;
  }
  write(message, is_signed) {
    const sequence = this.frames.length % 256;
    const sender = senders[this.#random(senders.length)];
    const { MavLinkProtocolV2: v2 } = mavlink;
    const protocol = new v2(...sender, is_signed ? v2.IFLAG_SIGNED : 0);
    const plain = protocol.serialize(message, sequence);
    if (!is_signed) {
      this.frames.push(plain);
      this.descriptions.push(describe(message, sequence, sender));
      return;
    }
    const at_ms = signing_ms + this.#signed++;
    this.frames.push(protocol.sign(plain, link, test_key, at_ms));
    const time = (at_ms - v2.SIGNATURE_START_TIME) * units_per_ms;
    this.descriptions.push(describe(message, sequence, sender, time));
  }
}

const to_lines = (descriptions) => descriptions.map((each) => JSON.stringify(each) + "\n").join("");

// FOLDER/frames.bin, FOLDER/frames.jsonl with one description a line, and FOLDER/changed.jsonl, where one field has
// another value: held against that our check must fail.
export function write_theirs(folder, classes, seed) {
  const random = random_numbers(seed);
  const writer = new frame_writer(random);
  for (const message_class of classes) {
    for (const is_signed of [false, true]) {
      for (const pattern of byte_patterns) writer.write(patterned(message_class, pattern), is_signed);
      for (let i = 0; i < random_frames; ++i) writer.write(randomised(message_class, random), is_signed);
    }
  }
  mkdirSync(folder, { recursive: true });
  writeFileSync(join(folder, "frames.bin"), Buffer.concat(writer.frames));
  writeFileSync(join(folder, "frames.jsonl"), to_lines(writer.descriptions));
  const changed = structuredClone(writer.descriptions);
  changed.find((each) => each.message === "SYS_STATUS").fields.voltage_battery = "changed";
  writeFileSync(join(folder, "changed.jsonl"), to_lines(changed));
  return writer.descriptions;
}
