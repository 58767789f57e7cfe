// The way that the vehicle came, thinned as it grows: a point is kept where the way bends, and all of it within a bound.
//
//   position ──add──> [kept, kept, ..., kept] + [open: what was heard after the last kept one]
//
// Two hours at ten positions a second are 72,000; a straight line of any length is two. Pure.
import { deviation_m, distance_m } from "./geometry.ts";
import type { place } from "./messages.ts";

export const max_points = 4_000; // kept; when they are reached every bend has to be twice as wide
const max_open = 60; // positions that wait for a bend

export class track {
  kept: place[] = [];
  changed = 0; // rises when kept changes
  private open: place[] = [];
  private width_m: number;

  constructor(width_m = 0.7) {
    this.width_m = width_m;
  }

  // The newest place, after all that was kept.
  get last(): place | undefined {
    return this.open.at(-1) ?? this.kept.at(-1);
  }

  add(at: place): void {
    const from = this.kept.at(-1);
    if (from === undefined) return this.keep(at);
    const last = this.last;
    if (last !== undefined && distance_m(last, at) < 0.2) return;
    const bends = this.open.some((each) => deviation_m(each, from, at) > this.width_m);
    if (bends || this.open.length >= max_open) {
      const corner = this.open.at(-1);
      if (corner !== undefined) this.keep(corner);
      this.open = [];
    }
    this.open.push(at);
  }

  clear(): void {
    this.kept = [];
    this.open = [];
    this.changed += 1;
  }

  private keep(at: place): void {
    this.kept.push(at);
    this.changed += 1;
    while (this.kept.length > max_points) {
      this.width_m *= 2;
      this.kept = thinned(this.kept, this.width_m);
    }
  }
}

// What is left of WAY when bends below WIDTH_M are left out; at least every second point goes when none would.
export function thinned(way: place[], width_m: number): place[] {
  const result: place[] = [];
  let open: place[] = [];
  for (const each of way) {
    const from = result.at(-1);
    if (from === undefined) {
      result.push(each);
      continue;
    }
    if (open.some((one) => deviation_m(one, from, each) > width_m) || open.length >= max_open) {
      result.push(open.at(-1) as place);
      open = [];
    }
    open.push(each);
  }
  result.push(...open.slice(-1));
  return result.length < way.length ? result : way.filter((_, index) => index % 2 === 0);
}
