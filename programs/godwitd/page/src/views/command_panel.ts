// What an operator can say: control, and the commands. A refusal stands beside its button.
import { html, nothing } from "lit";
import type { TemplateResult } from "lit";
import { command_rows, pointed_row_of, pointed_rows } from "../model/commands.ts";
import type { command_row, pointed_row } from "../model/commands.ts";
import { distance_m, item_after } from "../model/geometry.ts";
import { distance_words } from "../model/words.ts";
import type { page } from "../page.ts";
import { hold_button } from "./hold_button.ts";

export function refusal(all: page, what: string): TemplateResult | typeof nothing {
  const words = all.commander.refusals.get(what);
  return words === undefined ? nothing : html`<p class="refusal" role="alert" id="refusal-${what}">${words}</p>`;
}

// Why it can not be said; empty: it can.
export function why_not(all: page, is_stop: boolean): string {
  if (all.me === undefined) return "log in first";
  if (all.me.role === "viewer") return "a viewer may look only";
  return is_stop || all.control?.is_yours === true ? "" : "take control first";
}

function command_button(all: page, row: command_row): TemplateResult {
  const reason = why_not(all, row.is_stop);
  return html`<div class="command ${row.is_stop ? "stop" : ""}">
    ${hold_button({ id: `command-${row.name}`, label: row.label, key: row.key, hint: reason === "" ? row.hint : reason,
      tone: row.is_stop ? "stop" : "", is_held: row.moves, is_disabled: reason !== "",
      is_busy: all.commander.under_way.has(row.name), act: () => void all.commander.say(row.name) })}
    ${refusal(all, row.name)}
  </div>`;
}

function pointed_button(all: page, row: pointed_row): TemplateResult {
  const reason = why_not(all, false);
  return html`<div class="command"><button id="command-${row.name}" class="act" type="button" ?disabled=${reason !== ""}
      title=${reason || row.hint} @click=${() => { all.commander.begin_pointing(row.name); all.draw(); }}>
    <span>${row.label}</span><kbd aria-hidden="true">${row.key}</kbd></button>${refusal(all, row.name)}</div>`;
}

// After which item, and where the mission goes on then.
function after_part(all: page): TemplateResult | typeof nothing {
  const { commander } = all;
  const mission = all.plan?.mission;
  if (commander.pointing !== "insert" || mission === null || mission === undefined) return nothing;
  const done = all.world.get("progress")?.items_done ?? 0;
  const next = item_after(mission, commander.after, done);
  return html`<label>As the next one, or after <select id="insert-after" @change=${(event: Event) => {
      commander.after = (event.target as HTMLSelectElement).value;
      all.draw();
    }}><option value="" ?selected=${commander.after === ""}>the next one</option>${mission.items.slice(done).map((item) =>
      html`<option value=${item.id} ?selected=${commander.after === item.id}>${item.id}</option>`)}</select></label>
    <p id="insert-then">${next === undefined ? "Then the mission is at its end." : html`Then on with <b>${next.id}</b>.`}</p>`;
}

function pointed_part(all: page, row: pointed_row): TemplateResult {
  const { commander } = all;
  const at = all.vehicle();
  const target = commander.target;
  const reason = why_not(all, false);
  const far = at === undefined || target === undefined ? "" : `, ${distance_words(distance_m(at, target))} from the vehicle`;
  return html`<section class="going" aria-label=${row.hint}>
    <p>${target === undefined ? "Click the place on the map." :
      `${target.latitude.toFixed(6)}, ${target.longitude.toFixed(6)}${far}`}</p>
    ${after_part(all)}
    <label>Altitude above home <input id="go-to-altitude" type="number" min="1" max="500" step="1" .value=${String(commander.altitude_m)}
      @input=${(event: Event) => { commander.altitude_m = Number((event.target as HTMLInputElement).value); }}> m</label>
    <div class="row">${hold_button({ id: `confirm-${row.name}`, label: row.confirm, hint: reason || "hold to confirm", is_held: true,
        is_disabled: reason !== "" || target === undefined || !(commander.altitude_m > 0), is_busy: commander.under_way.has(row.name),
        act: () => void commander.confirm() })}
      <button class="act" type="button" @click=${() => commander.end_pointing()}><span>Cancel</span></button></div>
    ${refusal(all, row.name)}
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
  const { pointing } = all.commander;
  return html`<section class="commands" aria-label="Commands">
    ${control_part(all)}
    ${pointing === undefined ? nothing : pointed_part(all, pointed_row_of(pointing))}
    <div class="command-grid">${command_rows.map((row) => command_button(all, row))}${pointing === undefined ? pointed_rows.map((row) => pointed_button(all, row)) : nothing}</div>
  </section>`;
}
