// The stream of godwitd as a WebSocket that comes back: what is heard goes to the listener, and when the line is gone or
// silent it is opened anew within a second.
import type { stream_text, text } from "../model/messages.ts";

const topics = "position,attitude,battery,gps,home,link,flight,authority,progress,map,points,health,log,missions,way_home,traffic";
const first_wait_ms = 250;
const longest_wait_ms = 1_000;
const deaf_ms = 4_000; // no text for so long: the line is dead, whatever the browser says

export interface listener {
  on_open(): void;
  on_text(heard: text | stream_text): void;
  on_closed(): void;
}

export class stream {
  private socket: WebSocket | undefined;
  private wait_ms = first_wait_ms;
  private retry: ReturnType<typeof setTimeout> | undefined;
  private heard_at = 0;

  constructor(private readonly to: listener) {}

  open(): void {
    clearTimeout(this.retry);
    const scheme = location.protocol === "https:" ? "wss:" : "ws:";
    const socket = new WebSocket(`${scheme}//${location.host}/api/v1/stream?topics=${topics}`);
    this.socket = socket;
    this.heard_at = performance.now();
    socket.onopen = () => {
      this.wait_ms = first_wait_ms;
      this.to.on_open();
    };
    socket.onmessage = (event: MessageEvent<string>) => {
      this.heard_at = performance.now();
      this.to.on_text(JSON.parse(event.data) as text | stream_text);
    };
    socket.onclose = () => this.lost(socket);
  }

  // To be called now and then: a line that has died without a word is given up.
  look(): void {
    if (this.socket !== undefined && performance.now() - this.heard_at > deaf_ms) {
      const socket = this.socket;
      this.lost(socket);
      socket.close();
    }
  }

  private lost(socket: WebSocket): void {
    if (socket !== this.socket) return;
    this.socket = undefined;
    this.to.on_closed();
    this.retry = setTimeout(() => this.open(), this.wait_ms);
    this.wait_ms = Math.min(longest_wait_ms, 2 * this.wait_ms);
  }
}
