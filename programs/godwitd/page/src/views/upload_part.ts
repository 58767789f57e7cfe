// A mission out of a file: what godwitd says of it, before and when it is handed over.
import { html, nothing } from "lit";
import type { TemplateResult } from "lit";
import type { page } from "../page.ts";
import { hold_button } from "./hold_button.ts";

function losses_part(all: page): TemplateResult | typeof nothing {
  const { checked } = all.uploader;
  if (checked === undefined || checked.losses.length === 0) return nothing;
  return html`<p>Taken without this:</p><ul class="losses">${checked.losses.map((each) => html`<li>${each.item === null ? "" : `item ${each.item}: `}${each.what};
    ${each.why}${each.instead === "" ? "" : `; instead: ${each.instead}`}</li>`)}</ul>`;
}

export function upload_part(all: page): TemplateResult {
  const { uploader } = all;
  const choose = (event: Event) => {
    const input = event.target as HTMLInputElement;
    const file = input.files?.[0];
    if (file !== undefined) void uploader.take(file);
    input.value = "";
  };
  const may = all.me !== undefined && all.me.role !== "viewer" && all.control?.is_yours === true;
  const mission = uploader.checked?.mission;
  return html`<div class="upload">
    <label class="drop">Drop a mission here, or choose one: .plan, .waypoints, .geojson, .kml, .json
      <input id="mission-file" type="file" accept=".plan,.waypoints,.txt,.geojson,.kml,.json" @change=${choose}></label>
    ${uploader.taken === "" ? nothing : html`<p class="taken" role="status">${uploader.taken}</p>`}
    ${mission === undefined ? nothing : html`<p><b>${uploader.name}</b>: ${mission.items.length} items,
        ${mission.geofences.length} fence${mission.geofences.length === 1 ? "" : "s"}. It is drawn on the map.</p>`}
    ${losses_part(all)}
    ${uploader.refusal === "" ? nothing : html`<p class="refusal lines" role="alert" id="refusal-mission">${uploader.refusal}</p>`}
    ${uploader.name === "" ? nothing : html`<div class="row">
      ${hold_button({ id: "hand-over-mission", label: "Take this mission", hint: may ? "it is checked, and starts on command" : "take control first",
        is_held: true, is_disabled: !may || mission === undefined, is_busy: uploader.is_busy, act: () => void uploader.hand_over() })}
      <label><input type="checkbox" .checked=${uploader.is_partial}
        @change=${(event: Event) => void uploader.set_partial((event.target as HTMLInputElement).checked)}> without what can not be carried over</label>
      <button class="act" type="button" @click=${() => uploader.leave()}><span>Cancel</span></button></div>`}
  </div>`;
}
