// What needs a person: it sounds, and stays until it is seen. Pure.
//
// An alarm has a key: it is raised when what it says begins to hold, once, and can be raised again when it has ceased
// to hold meanwhile.
import type { log_update, point_of_interest } from "./messages.ts";
import type { world } from "./world.ts";
import { plain } from "./words.ts";

export interface alarm {
  key: string;
  words: string;
  at_ms: number; // by the clock of godwitd
}

export const max_alarms = 20; // the oldest goes

// Of what holds for a moment at each start of godwitd, until it has heard the vehicle: it is an alarm when it lasts.
export const lasting_ms = 2_000;
const begins_with_start = ["link", "authority/unclear", "health/"];

export class alarms {
  list: alarm[] = [];
  private holding = new Map<string, number>(); // since when; raised: -Infinity
  private points = new Set<number>(); // that were shown last

  // True: there is a new one.
  look(all: world, now: number): boolean {
    const holds = holding_now(all, now);
    let is_new = false;
    const before = this.holding;
    this.holding = new Map();
    for (const [key, words] of holds) {
      const since = before.get(key) ?? now;
      const is_due = !begins_with_start.some((each) => key.startsWith(each)) || now - since >= lasting_ms;
      this.holding.set(key, is_due ? -Infinity : since);
      if (since === -Infinity || !is_due) continue;
      this.raise(key, words, all.godwit_ms(now));
      is_new = true;
    }
    return this.look_at_points(all, now) || is_new;
  }

  // One for all points of interest that wait for a decision: it goes with the last of them, since nobody can decide then.
  private look_at_points(all: world, now: number): boolean {
    const shown = all.get("points")?.shown ?? [];
    const is_new = shown.some((each) => !this.points.has(each.number));
    this.points = new Set(shown.map((each) => each.number));
    const words = points_words(shown);
    if (shown.length === 0) this.see(points_key);
    else if (is_new) this.raise(points_key, words, all.godwit_ms(now));
    else this.list = this.list.map((each) => (each.key === points_key ? { ...each, words } : each));
    return is_new;
  }

  // True: it is about another aircraft, which the executor tells of once as it comes.
  hear(line: log_update, at_ms: number): boolean {
    if (line.part !== "executor" || !line.is_warning || !says_traffic.test(line.sentence)) return false;
    this.raise(`traffic/${line.sentence}`, line.sentence, at_ms);
    return true;
  }

  // Something that has happened, and not something that holds.
  raise(key: string, words: string, at_ms: number): void {
    this.list = [...this.list.filter((each) => each.key !== key), { key, words, at_ms }].slice(-max_alarms);
  }

  see(key: string): void {
    this.list = this.list.filter((each) => each.key !== key);
  }

  see_all(): void {
    this.list = [];
  }
}

const says_traffic = /^(aircraft close: |other aircraft near |the autopilot warns of a collision )/;

const points_key = "points";

function points_words(shown: point_of_interest[]): string {
  const names = shown.map((each) => `${each.number} (${plain(each.class_group)})`).join(", ");
  return shown.length === 1 ? `Point of interest ${names} waits for a decision.` : `Points of interest wait for a decision: ${names}.`;
}

const taken_away: Record<string, string> = {
  person: "A person has taken the vehicle. Nothing is sent until it is handed back.",
  failsafe: "godwit's failsafe has the vehicle.",
  autopilot_failsafe: "The autopilot's own failsafe has the vehicle.",
  unclear: "It is not known who has the vehicle.",
};

function holding_now(all: world, now: number): Map<string, string> {
  const holds = new Map<string, string>();
  const flight = all.get("flight");
  const flies = flight?.in_flight === true;
  if (all.session !== "" && !all.is_heard(now))
    holds.set("silence", "godwitd is not heard. The flight goes on without this page; what it shows is old.");
  const holder = all.get("authority")?.holder ?? "";
  const words = taken_away[holder];
  if (words !== undefined && flies) holds.set(`authority/${holder}`, words);
  if (flight !== undefined && flight.phase === "paused" && flight.cause !== "asked")
    holds.set(`paused/${flight.cause}`, `The flight is paused (${plain(flight.cause)}): ${flight.sentence}`);
  if (flight !== undefined && flight.preflight_report !== 0)
    holds.set(`report/${flight.preflight_report}`, `Preflight report ${flight.preflight_report} waits for an acknowledgement.`);
  const link = all.get("link");
  if (link !== undefined && link.phase !== "connected" && flies)
    holds.set("link", `The vehicle is not heard: ${link.reason || plain(link.phase)}`);
  for (const part of all.get("health")?.parts ?? [])
    if (part.health === "red") holds.set(`health/${part.part}`, `${part.part}: ${part.reason || "does not work"}`);
  return holds;
}
