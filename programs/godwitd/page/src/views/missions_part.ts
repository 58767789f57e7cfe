// The missions that godwit knows: the one that is flown or prepared, what waits, what was refused, each with why, and
// those that were flown before. Below them a mission out of a file is handed over.
import { html } from "lit";
import type { TemplateResult } from "lit";
import type { known_mission } from "../model/messages.ts";
import { mission_words, origin_words } from "../model/words.ts";
import type { page } from "../page.ts";
import { upload_part } from "./upload_part.ts";

function mission_row(each: known_mission): TemplateResult {
  const { words, tone } = mission_words(each);
  const items = each.items === null ? "–" : each.items_done === null ? `${each.items}` : `${each.items_done} of ${each.items}`;
  return html`<tr data-place=${each.place}><td><span class="verdict ${tone}">${words}</span></td><td>${each.mission_id || "–"}</td>
    <td>${each.revision ?? "–"}</td><td>${origin_words(each.origin)}</td><td>${items}</td>
    <td class="time">${each.last_report_at === "" ? "–" : each.last_report_at.slice(11, 19)}</td><td>${each.reason}</td></tr>`;
}

export function missions_part(all: page): TemplateResult {
  const known = all.world.get("missions")?.list ?? [];
  return html`${known.length === 0 ? html`<p class="empty" id="no-missions">godwit knows no mission.</p>` : html`<table class="rows" id="missions">
      <caption class="hidden">Missions that godwit knows</caption>
      <thead><tr><th></th><th>mission</th><th>revision</th><th>from</th><th>items</th><th>last report</th><th></th></tr></thead>
      <tbody>${known.map(mission_row)}</tbody></table>`}
    ${upload_part(all)}`;
}
