// What an operator can say: control, and the commands. A refusal stands beside its button.
import { html, nothing } from "lit";
import type { TemplateResult } from "lit";
import { command_rows } from "../model/commands.ts";
import type { command_row } from "../model/commands.ts";
import { distance_m } from "../model/geometry.ts";
import { distance_words } from "../model/words.ts";
import type { page } from "../page.ts";
import { hold_button } from "./hold_button.ts";

function refusal(all: page, what: string): TemplateResult | typeof nothing {
  const words = all.commander.refusals.get(what);
  return words === undefined ? nothing : html`<p class="refusal" role="alert" id="refusal-${what}">${words}</p>`;
}

// Why it can not be said; empty: it can.
function why_not(all: page, is_stop: boolean): string {
  if (all.me === undefined) return "log in first";
  if (all.me.role === "viewer") return "a viewer looks and says nothing";
  return is_stop || all.control?.is_yours === true ? "" : "take control first";
}

function command_button(all: page, row: command_row): TemplateResult {
  const reason = why_not(all, row.is_stop);
  return html`<div class="command">
    ${hold_button({ id: `command-${row.name}`, label: row.label, key: row.key, hint: reason === "" ? row.hint : reason,
      tone: row.is_stop ? "stop" : "", is_held: row.moves, is_disabled: reason !== "",
      is_busy: all.commander.under_way.has(row.name), act: () => void all.commander.say(row.name) })}
    ${refusal(all, row.name)}
  </div>`;
}

function go_to_part(all: page): TemplateResult {
  const { commander } = all;
  const reason = why_not(all, false);
  if (!commander.is_pointing)
    return html`<div class="command"><button id="command-go_to" class="act" type="button" ?disabled=${reason !== ""}
        title=${reason || "fly to a place on the map, and stay there"} @click=${() => { commander.begin_pointing(); all.draw(); }}>
      <span>Go to…</span><kbd aria-hidden="true">g</kbd></button>${refusal(all, "go_to")}</div>`;
  const at = all.vehicle();
  const target = commander.target;
  const far = at === undefined || target === undefined ? "" : `, ${distance_words(distance_m(at, target))} from the vehicle`;
  return html`<section class="going" aria-label="Go to a place">
    <p>${target === undefined ? "Click the place on the map." :
      `${target.latitude.toFixed(6)}, ${target.longitude.toFixed(6)}${far}`}</p>
    <label>Altitude above home <input id="go-to-altitude" type="number" min="1" max="500" step="1" .value=${String(commander.altitude_m)}
      @input=${(event: Event) => { commander.altitude_m = Number((event.target as HTMLInputElement).value); }}> m</label>
    <div class="row">${hold_button({ id: "go-to-confirm", label: "Fly there", hint: "hold to confirm", is_held: true,
        is_disabled: target === undefined || !(commander.altitude_m > 0), is_busy: commander.under_way.has("go_to"),
        act: () => void commander.go_to("go_to") })}
      ${hold_button({ id: "insert-confirm", label: "Insert", hint: "hold to insert it as the next waypoint of the mission", is_held: true,
        is_disabled: target === undefined || !(commander.altitude_m > 0), is_busy: commander.under_way.has("insert"),
        act: () => void commander.go_to("insert") })}
      <button class="act" type="button" @click=${() => commander.end_pointing()}><span>Leave it</span></button></div>
    ${refusal(all, "go_to")}${refusal(all, "insert")}
  </section>`;
}

export function control_part(all: page): TemplateResult {
  const me = all.me;
  if (me === undefined)
    return html`<section id="control" class="control"><span class="words">Looking only.</span>
      <button class="act" id="show-login" type="button" @click=${() => { all.shows_login = true; all.draw(); }}><span>Log in</span></button></section>`;
  const holder = all.control?.holder ?? "";
  const is_mine = all.control?.is_yours === true;
  const words = is_mine ? "You have control." : holder === "" ? "Control is free." : `${holder} has control.`;
  const button = (id: string, label: string, act: () => void) =>
    html`<button class="act" id=${id} type="button" @click=${act}><span>${label}</span></button>`;
  return html`<section id="control" class="control ${is_mine ? "mine" : ""}">
    <span class="words">${words}</span>
    ${me.role === "viewer" ? nothing : is_mine
      ? html`${button("give-control", "Give", () => void all.change_control("give"))}
          ${button("hand-over", "Hand over…", () => { const to = prompt("To whom?"); if (to) void all.change_control("hand_over", to); })}`
      : holder === "" ? button("take-control", "Take control", () => void all.change_control("take"))
      : me.role === "engineer" ? button("take-over", "Take over", () => void all.change_control("take_over")) : nothing}
    ${refusal(all, "control")}
  </section>`;
}

export function command_panel(all: page): TemplateResult {
  return html`<section class="commands" aria-label="Commands">
    ${control_part(all)}
    <div class="command-grid">${command_rows.map((row) => command_button(all, row))}${all.commander.is_pointing ? nothing : go_to_part(all)}</div>
    ${all.commander.is_pointing ? go_to_part(all) : nothing}
  </section>`;
}
