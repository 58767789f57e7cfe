// A slow line to an address: a TCP proxy that lets BYTES_A_SECOND through each way, all connections together, and takes
// ROUND_TRIP_MS there and back, once more for opening a connection. Browsers can not slow down WebSockets by themselves.
import { createConnection, createServer } from "node:net";

// One direction: what is given to it arrives in its order, when the line has carried it.
class direction {
  constructor(bytes_a_second, delay_ms) {
    this.bytes_a_ms = bytes_a_second / 1000;
    this.delay_ms = delay_ms;
    this.free_at = 0;
  }

  carry(bytes, not_before, arrive) {
    this.free_at = Math.max(this.free_at, performance.now(), not_before) + bytes.length / this.bytes_a_ms;
    setTimeout(arrive, this.free_at + this.delay_ms - performance.now());
  }
}

// Returns the proxy's "host:port" and how to end it.
export async function slow_line(address, { bytes_a_second, round_trip_ms }) {
  const [host, port] = address.split(":");
  const there = new direction(bytes_a_second, round_trip_ms / 2);
  const back = new direction(bytes_a_second, round_trip_ms / 2);
  const sockets = new Set();
  const server = createServer({ noDelay: true }, (near) => {
    const opened_at = performance.now() + round_trip_ms;
    const far = createConnection({ host, port: Number(port), noDelay: true });
    near.on("close", () => far.destroy()); // nobody is there to hear the rest
    for (const [from, to, line] of [[near, far, there], [far, near, back]]) {
      sockets.add(from);
      from.on("data", (bytes) => line.carry(bytes, opened_at, () => to.writable && to.write(bytes)));
      from.on("end", () => line.carry("", opened_at, () => to.end()));
      from.on("error", () => to.destroy());
      from.on("close", () => sockets.delete(from));
    }
  });
  await new Promise((then) => server.listen(0, "127.0.0.1", then));
  return { address: `127.0.0.1:${server.address().port}`, end: () => {
    server.close();
    for (const each of sockets) each.destroy();
  } };
}
