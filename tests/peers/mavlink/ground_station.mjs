// A ground station made of node-mavlink and nothing of ours: speaks with a vehicle over UDP, and keeps what it hears.
//
// The transfers of plans are its own, request by request, as the MAVLink guide describes them.
import { createSocket } from "node:dgram";
import { once } from "node:events";
import { PassThrough } from "node:stream";

import { mavlink } from "./definitions.mjs";

const identity = [255, 190]; // system and component, as ground stations have
const patience_ms = 60_000;
const silence_ms = 1_500; // then what was asked is asked again
const heartbeat_ms = 500;

export class ground_station {
  heard = []; // { name, id, message }, oldest first
  #classes;
  #socket = createSocket("udp4");
  #stream = new PassThrough();
  #protocol = new mavlink.MavLinkProtocolV2(...identity);
  #old_protocol = new mavlink.MavLinkProtocolV1(...identity);
  #sequence = 0;
  #port;
  #timer;
  #wake = () => {};

  constructor(port, { classes, magic_numbers }) {
    this.#port = port;
    this.#classes = classes;
    this.#socket.on("message", (bytes) => this.#stream.write(bytes));
    const packets = mavlink.createMavLinkStream(this.#stream, { magicNumbers: magic_numbers });
    packets.on("data", (packet) => this.#take(packet));
    this.#heartbeat();
    this.#timer = setInterval(() => this.#heartbeat(), heartbeat_ms);
  }

  close() {
    clearInterval(this.#timer);
    this.#socket.close();
    this.#stream.end();
  }

  send(name, fields, protocol = this.#protocol) {
    const message_class = Object.values(this.#classes).find((each) => each.MSG_NAME === name);
    const message = Object.assign(new message_class(), fields);
    const bytes = protocol.serialize(message, this.#sequence++ % 256);
    this.#socket.send(bytes, this.#port, "127.0.0.1");
  }

  // The first message of one of NAMES from now on for which FITS holds, or of those heard since FROM.
  async wait_for(names, fits = () => true, within_ms = patience_ms, from = this.heard.length) {
    const end = Date.now() + within_ms;
    for (let at = from; ; ) {
      for (; at < this.heard.length; ++at) {
        if (names.includes(this.heard[at].name) && fits(this.heard[at].message)) return this.heard[at];
      }
      const left = end - Date.now();
      if (left <= 0) return undefined;
      await new Promise((resolve) => {
        const timer = setTimeout(resolve, left);
        this.#wake = () => { clearTimeout(timer); resolve(); };
      });
    }
  }

  // Sends by ASK and waits for the answer; asks again after some silence.
  async ask(ask, names, fits) {
    for (const end = Date.now() + patience_ms; Date.now() < end; ) {
      const from = this.heard.length;
      ask();
      const answer = await this.wait_for(names, fits, silence_ms, from);
      if (answer) return answer;
    }
    throw new Error(`no ${names.join(" or ")} within ${patience_ms / 1000} s`);
  }

  async command(command, parameters = []) {
    const [_param1, _param2, _param3, _param4, _param5, _param6, _param7] = [...parameters, 0, 0, 0, 0, 0, 0, 0];
    const answer = await this.ask(
      () => this.send("COMMAND_LONG", { targetSystem: 1, targetComponent: 1, command, _param1, _param2, _param3,
        _param4, _param5, _param6, _param7 }),
      ["COMMAND_ACK"], (ack) => ack.command === command);
    return answer.message.result;
  }

  async upload(items, mission_type = 0) {
    const target = { targetSystem: 1, targetComponent: 1, missionType: mission_type };
    const wanted = ["MISSION_REQUEST_INT", "MISSION_REQUEST", "MISSION_ACK"];
    let answer = await this.ask(() => this.send("MISSION_COUNT", { ...target, count: items.length }), wanted);
    while (answer.name !== "MISSION_ACK") {
      const { seq } = answer.message;
      // What is asked for again while we answer is a repetition: the same answer will do.
      answer = await this.ask(() => this.send("MISSION_ITEM_INT", { ...target, ...items[seq], seq }), wanted,
        (message) => message.type !== undefined || message.seq !== seq);
    }
    return answer.message.type;
  }

  async download(mission_type = 0) {
    const target = { targetSystem: 1, targetComponent: 1, missionType: mission_type };
    const { message: { count } } = await this.ask(() => this.send("MISSION_REQUEST_LIST", target), ["MISSION_COUNT"],
      ({ missionType }) => missionType === mission_type);
    const items = [];
    for (let seq = 0; seq < count; ++seq) {
      const { message } = await this.ask(() => this.send("MISSION_REQUEST_INT", { ...target, seq }),
        ["MISSION_ITEM_INT"], (item) => item.seq === seq && item.missionType === mission_type);
      items.push(message);
    }
    this.send("MISSION_ACK", { ...target, type: 0 });
    return items;
  }

  // In MAVLink 2, and in MAVLink 1 as an old station beside us would send it.
  #heartbeat() {
    const fields = { type: 6, autopilot: 8, baseMode: 0, customMode: 0, systemStatus: 4, mavlinkVersion: 3 };
    this.send("HEARTBEAT", fields);
    this.send("HEARTBEAT", fields, this.#old_protocol);
  }

  #take(packet) {
    const message_class = this.#classes[packet.header.msgid];
    if (!message_class || packet.header.sysid !== 1) return;
    const message = packet.protocol.data(packet.payload, message_class);
    this.heard.push({ name: message_class.MSG_NAME, id: packet.header.msgid, message });
    this.#wake();
  }
}

// Ends the program; how it ends is checked only when it was still running.
export async function end(program) {
  if (program === undefined || program.exitCode !== null) return;
  program.kill("SIGTERM");
  const [code] = await once(program, "exit");
  if (code !== 0) throw new Error(`${program.spawnfile} ended with ${code}`);
}

// The ports on which the vehicle of PROGRAM listens, one for each of its LINES.
export async function ports_of(program, lines = 1) {
  let text = "";
  for (;;) {
    const found = [...text.matchAll(/udpin:\/\/127\.0\.0\.1:(\d+)/g)].map(([, port]) => Number(port));
    if (found.length >= lines) return found.slice(0, lines);
    const [more] = await Promise.race([once(program.stdout, "data"), once(program, "exit").then(() => [undefined])]);
    if (more === undefined) throw new Error(`the program ended before its vehicle listened: ${text}`);
    text += more;
  }
}
