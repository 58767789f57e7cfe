// The rules of godwit's failsafe: which one acts, which are kept from acting and why, and the word that does so.
import { html, nothing } from "lit";
import type { TemplateResult } from "lit";
import { duration_words, plain, time_words } from "../model/words.ts";
import type { page } from "../page.ts";
import { refusal, why_not } from "./command_panel.ts";
import { hold_button } from "./hold_button.ts";

// As docs/operations.md has them, with the settings that are usual.
const rules = [
  { name: "battery_critical", words: "a critical battery: lands; a fixed wing returns", can_be_overridden: false },
  { name: "fence", words: "outside the fences of the mission: returns", can_be_overridden: true },
  { name: "battery_low", words: "a low battery: returns", can_be_overridden: true },
  { name: "operator_link", words: "no ground station is heard any more: returns", can_be_overridden: true },
] as const;

function why_not_overridden(all: page): string {
  const reason = why_not(all, false);
  return reason !== "" ? reason : all.me?.role === "engineer" ? "" : "an engineer overrides a rule of the failsafe";
}

function override_form(all: page): TemplateResult {
  const { override } = all.commander;
  const reason = why_not_overridden(all);
  const said = (event: Event) => (event.target as HTMLInputElement | HTMLSelectElement).value;
  return html`<div class="override"><div class="row">
    <label>Rule <select id="override-rule" @change=${(event: Event) => { override.rule = said(event); all.draw(); }}>
      ${rules.filter((each) => each.can_be_overridden).map((each) => html`<option value=${each.name} ?selected=${override.rule === each.name}>${plain(each.name)}</option>`)}</select></label>
    <label>for <input id="override-minutes" type="number" min="1" max="60" step="1" .value=${String(override.minutes)}
      @input=${(event: Event) => { override.minutes = Number(said(event)); all.draw(); }}> min</label>
    <label>because <input id="override-reason" maxlength="150" .value=${override.reason}
      @input=${(event: Event) => { override.reason = said(event); all.draw(); }}></label>
    ${hold_button({ id: "command-override", label: "Override", hint: reason || "what the rule has done is lifted; the vehicle does what it does until you say something else",
      is_held: true, is_disabled: reason !== "" || override.reason.trim() === "" || !(override.minutes >= 1), is_busy: all.commander.under_way.has("override"),
      act: () => void all.commander.say_override() })}</div>
    ${reason === "" ? nothing : html`<p class="empty" id="override-why-not">${reason.slice(0, 1).toUpperCase() + reason.slice(1)}.</p>`}
    ${refusal(all, "override")}</div>`;
}

export function failsafe_part(all: page): TemplateResult {
  const status = all.drawer.status;
  const failsafe = status?.failsafe;
  if (failsafe === undefined || failsafe === null) return html`<p class="empty">Nothing was heard of the failsafe yet.</p>`;
  const now_ms = all.world.godwit_ms(all.now());
  const row = (rule: (typeof rules)[number]) => {
    const held = failsafe.overridden.find((each) => each.scope === rule.name);
    const acts = failsafe.reacts?.why === rule.name;
    return html`<tr class=${acts ? "warning" : ""} data-rule=${rule.name}><td>${plain(rule.name)}</td><td>${rule.words}</td>
      <td>${acts ? html`<span class="verdict bad">acts</span> ${plain(failsafe.reacts?.what ?? "")}, ${plain(failsafe.reacts?.stage ?? "")}`
        : held !== undefined ? html`<span class="verdict warn">overridden</span> until ${time_words(held.until_ns / 1e6)} UTC (${duration_words(held.until_ns / 1e6 - now_ms)}): ${held.reason}`
        : html`<span class="verdict good">watches</span>${rule.can_be_overridden ? nothing : " can not be overridden"}`}</td></tr>`;
  };
  return html`<table class="rows"><caption class="hidden">The rules of the failsafe</caption><tbody>${rules.map(row)}</tbody></table>${override_form(all)}`;
}
