// Objects of the map, of the part that is shown: asked for when another part is shown and when the map has changed, and
// at most once a second.
import { bbox_of } from "./model/geometry.ts";
import type { shown_part } from "./model/geometry.ts";
import type { objects_view } from "./model/messages.ts";
import { ask } from "./net/api.ts";

const gap_ms = 1_000;

export class objects {
  seen: objects_view | undefined;
  private timer: ReturnType<typeof setTimeout> | undefined;
  private asked_at = -Infinity;

  constructor(private readonly part: () => shown_part | undefined, private readonly on_seen: (seen: objects_view) => void) {}

  // What is shown may be another part, or the map another one.
  refresh(): void {
    if (this.timer !== undefined) return;
    this.timer = setTimeout(() => {
      this.timer = undefined;
      void this.fetch();
    }, Math.max(0, this.asked_at + gap_ms - performance.now()));
  }

  private async fetch(): Promise<void> {
    const part = this.part();
    if (part === undefined) return;
    this.asked_at = performance.now();
    const got = await ask<objects_view>("GET", `/api/v1/map/objects?bbox=${bbox_of(part)}`);
    if (!got.ok) return; // asked again at the next change
    this.seen = got.what;
    this.on_seen(got.what);
  }
}
