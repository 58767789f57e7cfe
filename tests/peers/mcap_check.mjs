#!/usr/bin/env node
// Reads MCAP files with an implementation that is not ours (@mcap/core), and says whether they are what they claim.
//
//   node mcap_check.mjs [--expect-messages N] [--expect-complete] FILE...
//
// Every file is read as a stream: structure, chunk CRCs and the CRC of the data section; JSON messages must parse and
// have what their JSON Schema requires. A file with its end is read again through its index, which must lead to the
// same messages. Prints a line a file; exit 1 when any file has an error, 2 on wrong usage.
import { readFileSync } from "node:fs";
import { parseArgs } from "node:util";

let mcap;
let crc32;
let zstd;
try {
  mcap = await import("@mcap/core");
  zstd = await import("fzstd");
  ({ crc32 } = await import("@foxglove/crc"));
} catch (error) {
  console.error("mcap_check: @mcap/core, @foxglove/crc and fzstd can not be loaded from tests/peers; run ./dev test, which " +
    `installs them. (${error.message})`);
  process.exit(1);
}

// The size is given so that what is longer or shorter is not taken.
const decompressHandlers = { zstd: (bytes, size) => zstd.decompress(bytes, new Uint8Array(Number(size))) };
const data_end_opcode = 0x0f;
const magic_bytes = 8;
const prefix_bytes = 9;

// The parts of JSON Schema that tell whether a document has the shape it should: type, required, properties, items.
function schema_violations(schema, value, path = "$") {
  const types = { object: (v) => v !== null && typeof v === "object" && !Array.isArray(v), array: Array.isArray,
    string: (v) => typeof v === "string", boolean: (v) => typeof v === "boolean", null: (v) => v === null,
    number: (v) => typeof v === "number", integer: (v) => Number.isInteger(v) };
  const allowed = schema.type === undefined ? [] : [schema.type].flat();
  if (allowed.length > 0 && !allowed.some((name) => types[name]?.(value))) {
    return [`${path} is not of type ${allowed.join(" or ")}`];
  }
  const found = [];
  if (types.object(value)) {
    for (const key of schema.required ?? []) {
      if (!Object.hasOwn(value, key)) found.push(`${path} has no "${key}"`);
    }
    for (const [key, inner] of Object.entries(schema.properties ?? {})) {
      if (Object.hasOwn(value, key)) found.push(...schema_violations(inner, value[key], `${path}.${key}`));
    }
  }
  if (Array.isArray(value) && schema.items) {
    value.forEach((item, i) => found.push(...schema_violations(schema.items, item, `${path}[${i}]`)));
  }
  return found;
}

class message_checker {
  schemas = new Map();
  channels = new Map();
  messages = 0;
  #decoder = new TextDecoder("utf-8", { fatal: true });

  add(record) {
    if (record.type === "Schema") this.#add_schema(record);
    if (record.type === "Channel") this.#add_channel(record);
    if (record.type === "Message") this.#add_message(record);
  }
  #add_schema(record) {
    const json = record.encoding === "jsonschema";
    this.schemas.set(record.id, json ? JSON.parse(this.#decoder.decode(record.data)) : undefined);
  }
  #add_channel(record) {
    if (record.schemaId !== 0 && !this.schemas.has(record.schemaId)) {
      throw new Error(`channel ${record.topic} names schema ${record.schemaId}, which was not defined before it`);
    }
    this.channels.set(record.id, record);
  }
  #add_message(record) {
    const channel = this.channels.get(record.channelId);
    if (!channel) throw new Error(`message on channel ${record.channelId}, which was not defined before it`);
    this.messages += 1;
    if (channel.messageEncoding !== "json") return;
    const value = JSON.parse(this.#decoder.decode(record.data));
    const violations = schema_violations(this.schemas.get(channel.schemaId) ?? {}, value);
    if (violations.length > 0) {
      throw new Error(`message ${record.sequence} on ${channel.topic}: ${violations.join(", ")}`);
    }
  }
}

function read_stream(bytes) {
  const reader = new mcap.McapStreamReader({ validateCrcs: true, decompressHandlers });
  const checker = new message_checker();
  reader.append(bytes);
  for (let record; (record = reader.nextRecord()); ) checker.add(record);
  return { checker, complete: reader.done(), torn_bytes: reader.bytesRemaining() };
}

// The CRC of the data section, which @mcap/core does not check.
function check_data_section_crc(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  let at = magic_bytes;
  while (view.getUint8(at) !== data_end_opcode) at += prefix_bytes + Number(view.getBigUint64(at + 1, true));
  const expected = view.getUint32(at + prefix_bytes, true);
  if (expected !== 0 && expected !== crc32(bytes.subarray(0, at))) throw new Error("incorrect data section CRC");
}

async function check_index(bytes, streamed) {
  const readable = {
    size: async () => BigInt(bytes.length),
    read: async (offset, size) => bytes.subarray(Number(offset), Number(offset + size)),
  };
  const reader = await mcap.McapIndexedReader.Initialize({ readable, decompressHandlers });
  let messages = 0;
  let last_time = 0n;
  for await (const message of reader.readMessages({ validateCrcs: true })) {
    if (message.logTime < last_time) throw new Error("the index gives messages out of order");
    last_time = message.logTime;
    messages += 1;
  }
  let metadata = 0;
  for await (const record of reader.readMetadata()) metadata += record.type === "Metadata" ? 1 : 0;
  const counts = { messages, channels: reader.channelsById.size, schemas: reader.schemasById.size };
  const expected = { messages: streamed.messages, channels: streamed.channels.size, schemas: streamed.schemas.size };
  const statistics = { messages: Number(reader.statistics?.messageCount), channels: reader.statistics?.channelCount,
    schemas: reader.statistics?.schemaCount };
  for (const key of Object.keys(expected)) {
    if (counts[key] !== expected[key] || statistics[key] !== expected[key]) {
      throw new Error(`${key}: stream ${expected[key]}, index ${counts[key]}, statistics ${statistics[key]}`);
    }
  }
  if (reader.statistics.metadataCount !== metadata) throw new Error("the metadata index is not complete");
}

async function check_file(path, options) {
  const bytes = readFileSync(path);
  const { checker, complete, torn_bytes } = read_stream(bytes);
  if (complete) {
    check_data_section_crc(bytes);
    await check_index(bytes, checker);
  } else if (options["expect-complete"]) {
    throw new Error("truncated");
  }
  const expected = options["expect-messages"];
  if (expected !== undefined && checker.messages !== Number(expected)) {
    throw new Error(`${checker.messages} messages, expected ${expected}`);
  }
  const end = complete ? "complete" : `truncated (${torn_bytes} bytes behind the last whole record)`;
  return `${checker.messages} messages, ${checker.channels.size} channels, ${checker.schemas.size} schemas, ${end}`;
}

function usage(reason) {
  console.error(`mcap_check: ${reason}`);
  console.error("usage: node mcap_check.mjs [--expect-messages N] [--expect-complete] FILE...");
  process.exit(2);
}

function parse_command_line() {
  try {
    return parseArgs({
      allowPositionals: true,
      options: { "expect-messages": { type: "string" }, "expect-complete": { type: "boolean" } },
    });
  } catch (error) {
    return usage(error.message);
  }
}

const { values, positionals } = parse_command_line();
if (positionals.length === 0) usage("no file");
if (values["expect-messages"] !== undefined && !/^\d+$/.test(values["expect-messages"])) {
  usage("--expect-messages needs a number");
}
let failed = false;
for (const path of positionals) {
  try {
    console.log(`${path}: ${await check_file(path, values)}`);
  } catch (error) {
    failed = true;
    console.log(`${path}: ERROR: ${error.message}`);
  }
}
process.exit(failed ? 1 : 0);
