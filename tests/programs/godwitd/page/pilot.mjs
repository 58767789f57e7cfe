// A pilot beside godwit: a ground station of its own that tells the simulated PX4 to change its mode. MAVLink 2 by hand
// (https://mavlink.io/en/guide/serialization.html): one COMMAND_LONG is all that it takes.
import { createSocket } from "node:dgram";

const command_long = { id: 76, crc_extra: 152 };
const do_set_mode = 176;
const custom_mode_enabled = 1;
const px4_position_control = 3;

// X.25, as MAVLink counts it.
function checksum(bytes) {
  let crc = 0xffff;
  for (const each of bytes) {
    let t = each ^ (crc & 0xff);
    t = (t ^ (t << 4)) & 0xff;
    crc = ((crc >> 8) ^ (t << 8) ^ (t << 3) ^ (t >> 4)) & 0xffff;
  }
  return crc;
}

function frame(payload, { id, crc_extra }) {
  const head = Buffer.from([payload.length, 0, 0, 0, 250, 190, id, 0, 0]);
  const tail = Buffer.alloc(2);
  tail.writeUInt16LE(checksum([...head, ...payload, crc_extra]));
  return Buffer.concat([Buffer.from([0xfd]), head, payload, tail]);
}

// Puts the vehicle that listens on PORT into position control: a person has it from then on.
export async function take_the_sticks(port) {
  const payload = Buffer.alloc(33);
  [custom_mode_enabled, px4_position_control, 0, 0, 0, 0, 0].forEach((value, index) => payload.writeFloatLE(value, 4 * index));
  payload.writeUInt16LE(do_set_mode, 28);
  payload.writeUInt8(1, 30);
  payload.writeUInt8(1, 31);
  const socket = createSocket("udp4");
  await new Promise((then) => socket.send(frame(payload, command_long), Number(port), "127.0.0.1", then));
  socket.close();
}
