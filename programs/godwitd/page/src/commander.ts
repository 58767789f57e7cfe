// Says commands: each once, with an id of its own, a deadline and the state of the flight that was seen; a refusal is
// kept for the place beside its button.
import type { command_name, pointed_command } from "./model/commands.ts";
import { body_of, command_id, refusal_words } from "./model/commands.ts";
import { way_of_insert } from "./model/geometry.ts";
import type { place } from "./model/messages.ts";
import { ask } from "./net/api.ts";
import type { page } from "./page.ts";

const tries = 3; // of a line that breaks: under one id it is obeyed once
const id_bytes = 12;

export class commander {
  refusals = new Map<string, string>(); // by command; "control"; "point-7"
  under_way = new Set<string>();
  pointing: pointed_command | undefined; // the next click on the map is its place
  target: place | undefined;
  after = ""; // of an insert: after this item; empty: next
  altitude_m = 30;
  override = { rule: "operator_link", minutes: 10, reason: "" }; // of the failsafe, as it is filled in

  constructor(private readonly page: page) {}

  refuse(what: string, words: string): void {
    if (words === "") this.refusals.delete(what);
    else this.refusals.set(what, words);
    this.page.draw();
  }

  async say(command: command_name, more: { report?: number; place?: place & { altitude_m: number }; after?: string } = {}): Promise<void> {
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

  // -- to a place: a click or a point of interest names it, holding the button confirms it -----------------

  begin_pointing(what: pointed_command, at?: place): void {
    this.pointing = what;
    this.target = at;
    this.after = "";
    this.altitude_m = Math.max(5, Math.round(this.page.world.get("position")?.altitude_m ?? 30));
    this.refuse(what, "");
    if (at !== undefined) this.page.see(this.way());
  }

  point_at(at: place): void {
    if (this.pointing === undefined) return;
    this.target = at;
    this.page.draw();
  }

  end_pointing(): void {
    this.pointing = undefined;
    this.target = undefined;
    this.page.draw();
  }

  // That is confirmed.
  way(): place[] {
    const { target, page } = this;
    const vehicle = page.vehicle();
    if (target === undefined) return [];
    if (this.pointing !== "insert") return vehicle === undefined ? [target] : [vehicle, target];
    return way_of_insert(page.plan?.mission ?? null, this.after, page.world.get("progress")?.items_done ?? 0, vehicle, target);
  }

  async confirm(): Promise<void> {
    const what = this.pointing;
    if (this.target === undefined || what === undefined) return;
    const place = { ...this.target, altitude_m: this.altitude_m };
    await this.say(what, what === "insert" && this.after !== "" ? { place, after: this.after } : { place });
    if (!this.refusals.has(what)) this.end_pointing();
  }

  // -- a point of interest: nothing moves by what is said of it --------------------------------------------

  async decide(number: number, decision: "confirm" | "decline"): Promise<void> {
    const what = `point-${number}`;
    if (this.under_way.has(what)) return;
    this.under_way.add(what);
    this.refuse(what, "");
    const got = await ask("POST", "/api/v1/points", { point: number, decision });
    this.under_way.delete(what);
    this.refuse(what, got.ok ? "" : refusal_words(got.why));
  }

  // -- the failsafe --------------------------------------------------------------------------------------

  async say_override(): Promise<void> {
    if (this.under_way.has("override")) return;
    const { rule, minutes, reason } = this.override;
    this.under_way.add("override");
    this.refuse("override", "");
    const got = await ask("POST", "/api/v1/overrides", { rule, seconds: Math.round(60 * minutes), reason: reason.trim() });
    this.under_way.delete("override");
    if (got.ok) this.override.reason = "";
    this.refuse("override", got.ok ? "" : refusal_words(got.why));
    this.page.drawer.refresh();
  }
}
