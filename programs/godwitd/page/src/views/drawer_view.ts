// Below the map: plan, points of interest, missions, plots, preflight report, failsafe, actors, log, audit.
import { html, nothing } from "lit";
import { guard } from "lit/directives/guard.js";
import { repeat } from "lit/directives/repeat.js";
import type { TemplateResult } from "lit";
import { plain, time_words } from "../model/words.ts";
import type { page } from "../page.ts";
import { actor_tree } from "./actor_tree.ts";
import { drawer_tabs } from "./drawer_state.ts";
import { failsafe_part } from "./failsafe_part.ts";
import { missions_part } from "./missions_part.ts";
import { points_part } from "./points_part.ts";
import { preflight_part } from "./preflight_part.ts";

function plan_part(all: page): TemplateResult {
  const mission = all.plan?.mission;
  if (mission === null || mission === undefined) return html`<p class="empty">There is no mission.</p>`;
  const done = all.world.get("progress")?.items_done ?? 0;
  return html`<table class="rows"><caption>Mission ${mission.mission_id}, revision ${mission.revision}: ${done} of ${mission.items.length} items done</caption>
    <thead><tr><th>#</th><th>item</th><th>kind</th><th>altitude</th><th></th></tr></thead>
    ${guard([mission, done], () => html`<tbody>${mission.items.map((item, index) => html`<tr class=${index < done ? "done" : index === done ? "next" : ""}>
      <td>${index + 1}</td><td>${item.id}</td><td>${plain(item.kind)}</td>
      <td>${item.at?.altitude_m ?? item.altitude_m ?? "–"}${(item.at?.altitude_m ?? item.altitude_m) === undefined ? "" : " m"}</td>
      <td>${index < done ? "done" : index === done ? "next" : ""}</td></tr>`)}</tbody>`)}</table>`;
}

function filter_part(all: page, with_warnings: boolean): TemplateResult {
  return html`<div class="filter"><label>Show only what has <input id="filter" type="search" .value=${all.drawer.filter}
      @input=${(event: Event) => { all.drawer.filter = (event.target as HTMLInputElement).value; all.draw(); }}></label>
    ${with_warnings ? html`<label><input type="checkbox" .checked=${all.drawer.only_warnings}
      @change=${(event: Event) => { all.drawer.only_warnings = (event.target as HTMLInputElement).checked; all.draw(); }}> warnings only</label>` : nothing}</div>`;
}

const has = (text: string, wanted: string) => text.toLowerCase().includes(wanted.toLowerCase());
const shown_rows = 300;

function log_part(all: page): TemplateResult {
  const { filter, only_warnings } = all.drawer;
  const lines = () => all.world.log.filter((each) => (!only_warnings || each.is_warning) && has(`${each.part} ${each.sentence}`, filter))
    .slice(-shown_rows).reverse();
  return html`${filter_part(all, true)}<table class="rows log"><caption class="hidden">The log, the newest first</caption><tbody>
    ${guard([all.world.log, filter, only_warnings], () => repeat(lines(), (each) => each.number, (each) => html`<tr class=${each.is_warning ? "warning" : ""}>
      <td class="time">${time_words(each.at_ms)}</td><td>${each.part}</td><td>${each.sentence}</td></tr>`))}</tbody></table>`;
}

function audit_part(all: page): TemplateResult {
  if (all.me === undefined) return html`<p class="empty">Log in to see who said what.</p>`;
  const rows = all.drawer.audit.filter((each) => has(`${each.who.name} ${each.what} ${each.outcome} ${each.reason}`, all.drawer.filter)).reverse();
  return html`${filter_part(all, false)}<table class="rows"><caption class="hidden">The audit, the newest first</caption>
    <thead><tr><th>time</th><th>who</th><th>what</th><th>outcome</th><th>reason</th></tr></thead>
    <tbody>${repeat(rows, (each) => each.number, (each) => html`<tr class=${each.outcome === "taken" || each.outcome === "done" ? "" : "warning"}>
      <td class="time">${each.at.slice(11, 19)}</td><td>${each.who.name || "nobody"}</td>
      <td>${each.what}${each.count > 1 ? ` ×${each.count}` : ""}</td><td>${plain(each.outcome)}</td><td>${each.reason}</td></tr>`)}</tbody></table>`;
}

function plots_part(all: page): TemplateResult {
  return html`${all.history.samples.length === 0 ? html`<p class="empty">No position was heard yet.</p>` : nothing}<div id="plots"></div>`;
}

const parts = { plan: plan_part, points: points_part, missions: missions_part, plots: plots_part, preflight: preflight_part, failsafe: failsafe_part, actors: actor_tree, log: log_part, audit: audit_part };

export function drawer_view(all: page): TemplateResult {
  const shown = all.drawer.tab;
  const waiting = all.world.get("points")?.shown.length ?? 0;
  const refused = all.world.get("missions")?.list.filter((each) => each.place === "refused").length ?? 0;
  const red = all.world.get("health")?.parts.filter((each) => each.health === "red").length ?? 0;
  return html`<section class="drawer ${shown === undefined ? "closed" : ""}" aria-label="Details">
    <div class="tabs" role="tablist">${drawer_tabs.map(({ name, label }, index) => html`<button role="tab" type="button" id="tab-${name}"
        aria-selected=${shown === name} aria-controls="tab-body" @click=${() => all.drawer.show(name)}>${label}
        ${name === "points" && waiting > 0 ? html`<b class="count warn">${waiting}</b>` : nothing}
        ${name === "missions" && refused > 0 ? html`<b class="count warn">${refused}</b>` : nothing}
        ${name === "actors" && red > 0 ? html`<b class="count bad">${red}</b>` : nothing}<kbd aria-hidden="true">${index + 1}</kbd></button>`)}</div>
    ${shown === undefined ? nothing : html`<div id="tab-body" class="tab-body ${shown}" role="tabpanel" tabindex="0" aria-labelledby="tab-${shown}">
      ${all.drawer.refusal === "" ? nothing : html`<p class="refusal">${all.drawer.refusal}</p>`}${parts[shown](all)}</div>`}
  </section>`;
}
