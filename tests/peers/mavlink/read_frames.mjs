// Reads frames with node-mavlink: splits, verifies the signatures, decodes, and describes what it found.
import { Readable } from "node:stream";

import { mavlink } from "./definitions.mjs";
import { texts_of } from "./field_text.mjs";

export const test_key = Buffer.from(Array.from({ length: 32 }, (_, i) => i));
const piece_size = 333; // longer than a frame, and no multiple of anything

function describe_header({ header, signature }) {
  const words = {
    id: String(header.msgid),
    sequence: String(header.seq),
    system: String(header.sysid),
    component: String(header.compid),
    signature: signature === null ? "none" : signature.matches(test_key) ? "right" : "wrong",
  };
  return signature === null
    ? words
    : { ...words, link: String(signature.linkId), time: String(signature.timestamp) };
}

function* pieces(bytes) {
  for (let at = 0; at < bytes.length; at += piece_size) yield bytes.subarray(at, at + piece_size);
}

// A description of every frame in BYTES whose message is in the definitions.
export async function read_frames(bytes, { classes, magic_numbers }) {
  const found = [];
  const input = Readable.from(pieces(bytes));
  for await (const packet of mavlink.createMavLinkStream(input, { magicNumbers: magic_numbers })) {
    const message_class = classes[packet.header.msgid];
    if (!message_class) continue;
    const message = packet.protocol.data(packet.payload, message_class);
    found.push({ message: message_class.MSG_NAME, frame: describe_header(packet), fields: texts_of(message) });
  }
  return found;
}
