// What the preflight checks have found, the worst first, each with what to do; and the word that is needed to fly with
// what is degraded.
import { html, nothing } from "lit";
import type { TemplateResult } from "lit";
import { plain, time_words } from "../model/words.ts";
import type { page } from "../page.ts";
import { hold_button } from "./hold_button.ts";

const ranks = ["fail", "degraded", "pass", "skipped"];
const tones: Record<string, string> = { fail: "bad", degraded: "warn", pass: "good", skipped: "none" };

function acknowledge_part(all: page, report: number): TemplateResult {
  const refused = all.commander.refusals.get("acknowledge");
  return html`<div class="acknowledge"><p>One can fly, and an operator has to say so: report ${report}.</p>
    ${hold_button({ id: "command-acknowledge", label: `Acknowledge report ${report}`, hint: "fly although the report is degraded",
      is_held: true, is_disabled: all.control?.is_yours !== true, is_busy: all.commander.under_way.has("acknowledge"),
      act: () => void all.commander.say("acknowledge", { report }) })}
    ${refused === undefined ? nothing : html`<p class="refusal" role="alert">${refused}</p>`}</div>`;
}

export function preflight_part(all: page): TemplateResult {
  const view = all.drawer.preflight;
  if (view === undefined) return html`<p class="empty">…</p>`;
  const findings = [...view.findings].sort((a, b) => ranks.indexOf(a.verdict) - ranks.indexOf(b.verdict));
  return html`<p class="summary"><b>${plain(view.phase)}</b>${view.reason === "" ? "" : `: ${view.reason}`}
      ${view.acknowledged_by === "" ? "" : `, acknowledged by ${view.acknowledged_by}`}
      ${view.looked_ms === 0 ? "" : `, looked at ${time_words(view.looked_ms)} UTC`}
      <button class="act small" type="button" ?disabled=${all.me === undefined} @click=${() => void all.commander.say("check")}><span>Repeat</span></button></p>
    ${all.commander.refusals.has("check") ? html`<p class="refusal">${all.commander.refusals.get("check")}</p>` : nothing}
    ${view.report === 0 ? nothing : acknowledge_part(all, view.report)}
    <table class="rows"><caption class="hidden">What the checks have found</caption><tbody>${findings.map((each) => html`<tr>
      <td><span class="verdict ${tones[each.verdict] ?? "none"}">${each.verdict}</span></td><td>${plain(each.check)}</td><td>${each.sentence}</td></tr>`)}</tbody></table>`;
}
