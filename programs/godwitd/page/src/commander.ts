// Says commands: each once, with an id of its own, a deadline and the state of the flight that was seen; a refusal is
// kept for the place beside its button.
import type { command_name } from "./model/commands.ts";
import { body_of, command_id, refusal_words } from "./model/commands.ts";
import type { place } from "./model/messages.ts";
import { ask } from "./net/api.ts";
import type { page } from "./page.ts";

const tries = 3; // of a line that breaks: under one id it is obeyed once
const id_bytes = 12;

export class commander {
  refusals = new Map<string, string>(); // by command; "control"
  under_way = new Set<string>();
  is_pointing = false; // the next click on the map is the place of a go-to
  target: place | undefined;
  altitude_m = 30;

  constructor(private readonly page: page) {}

  refuse(what: string, words: string): void {
    if (words === "") this.refusals.delete(what);
    else this.refusals.set(what, words);
    this.page.draw();
  }

  async say(command: command_name, more: { report?: number; place?: place & { altitude_m: number } } = {}): Promise<void> {
    if (this.under_way.has(command)) return;
    const page = this.page;
    const id = command_id(page.me?.name ?? "nobody", crypto.getRandomValues(new Uint8Array(id_bytes)));
    const state = page.world.get("flight")?.state ?? "";
    const body = body_of(command, id, state, page.world.godwit_ms(page.now()), more);
    this.under_way.add(command);
    this.refuse(command, "");
    for (let i = 0; i < tries; ++i) {
      const got = await ask<{ verdict: string }>("POST", "/api/v1/commands", body);
      if (got.ok) {
        this.refusals.clear(); // they were of a flight that stood otherwise
        break;
      }
      this.refuse(command, refusal_words(got.why));
      if (got.why.status !== 0) break;
    }
    this.under_way.delete(command);
    page.draw();
  }

  // -- go-to: a click shows the way, holding the button confirms it -------------------------------------

  begin_pointing(): void {
    this.is_pointing = true;
    this.target = undefined;
    this.altitude_m = Math.max(5, Math.round(this.page.world.get("position")?.altitude_m ?? 30));
    this.refuse("go_to", "");
    this.refuse("insert", "");
  }

  point_at(at: place): void {
    if (!this.is_pointing) return;
    this.target = at;
    this.page.draw();
  }

  end_pointing(): void {
    this.is_pointing = false;
    this.target = undefined;
    this.page.draw();
  }

  // INSERT: a waypoint behind the last item that is done, instead of a flight there now.
  async go_to(command: "go_to" | "insert"): Promise<void> {
    if (this.target === undefined) return;
    await this.say(command, { place: { ...this.target, altitude_m: this.altitude_m } });
    if (!this.refusals.has(command)) this.end_pointing();
  }
}
