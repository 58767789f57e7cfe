// What the page knows of the vehicle and the flight: the newest text of each topic, and how old it is by the clock of
// godwitd. Times: `now` is the browser's monotonic clock in milliseconds. Pure.
import type { log_update, stream_text, text, topic, topics } from "./messages.ts";
import { topic_names } from "./messages.ts";

export const silence_ms = 1_800; // no text for so long: godwitd does not speak, it beats each second
export const old_ms = 2_000; // a value that is older looks old
export const max_log_lines = 1_000; // the oldest goes

// Of these a new text comes all the time: their age is that of the value. What else there is holds until it changes.
const measured: ReadonlySet<topic> = new Set(["position", "attitude", "battery", "gps", "way_home"]);

export interface log_line extends log_update {
  number: number;
  at_ms: number;
}

export class world {
  session = "";
  is_open = false; // the stream
  heard_at = -Infinity; // anything
  dropped: Record<string, number> = {};
  log: log_line[] = [];
  private newest: { [T in topic]?: text<T> } = {};
  private offset_ms = 0; // clock of godwitd less that of the browser

  // True: it is another process than before, and all that it has said is forgotten.
  take(heard: text | stream_text, now: number): boolean {
    this.heard_at = now;
    if (heard.topic === "stream") return this.take_own(heard);
    if (!topic_names.includes(heard.topic)) return false; // of a newer godwitd
    if (heard.topic === "clock" || this.offset_ms === 0) this.offset_ms = heard.at_ms - now;
    (this.newest as Record<topic, text>)[heard.topic] = heard;
    if (heard.topic === "log") this.add_log([{ ...(heard.data as log_update), number: heard.number, at_ms: heard.at_ms }]);
    return false;
  }

  // Lines that were said before, too; each is kept once.
  add_log(lines: log_line[]): void {
    const known = new Set(this.log.map((each) => each.number));
    this.log = [...this.log, ...lines.filter((each) => !known.has(each.number))]
      .sort((a, b) => a.number - b.number).slice(-max_log_lines);
  }

  get<T extends topic>(which: T): topics[T] | undefined {
    return (this.newest[which] as text<T> | undefined)?.data;
  }

  // By the clock of godwitd.
  godwit_ms(now: number): number {
    return now + this.offset_ms;
  }

  is_heard(now: number): boolean {
    return this.is_open && now - this.heard_at <= silence_ms;
  }

  silent_ms(now: number): number {
    return Math.max(0, now - this.heard_at);
  }

  // Of a value; of what holds until it changes: since godwitd was heard last.
  age_ms(which: topic, now: number): number {
    const said = this.newest[which];
    if (said === undefined) return Infinity;
    return measured.has(which) ? Math.max(0, this.godwit_ms(now) - said.at_ms) : this.silent_ms(now);
  }

  // Since it was said.
  said_ms_ago(which: topic, now: number): number {
    const said = this.newest[which];
    return said === undefined ? Infinity : Math.max(0, this.godwit_ms(now) - said.at_ms);
  }

  is_old(which: topic, now: number): boolean {
    return this.age_ms(which, now) > old_ms;
  }

  private take_own(heard: stream_text): boolean {
    for (const [name, count] of Object.entries(heard.data.dropped ?? {})) this.dropped[name] = (this.dropped[name] ?? 0) + count;
    const session = heard.data.session;
    if (session === undefined || session === this.session) return false;
    const is_other = this.session !== "";
    this.session = session;
    this.newest = {};
    this.log = [];
    this.dropped = {};
    this.offset_ms = 0;
    return is_other;
  }
}
