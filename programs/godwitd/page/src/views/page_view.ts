// The whole page: a line above, the map with what needs a person over it, the instruments and commands at the side, the
// details below. The map's own element is never drawn anew.
import { html, nothing } from "lit";
import { repeat } from "lit/directives/repeat.js";
import type { TemplateResult } from "lit";
import { age_words, left_out_words, time_words } from "../model/words.ts";
import type { page, theme } from "../page.ts";
import { command_panel } from "./command_panel.ts";
import { drawer_view } from "./drawer_view.ts";
import { authority_block, instruments, phase_block } from "./flight_panel.ts";
import { login_view } from "./login_view.ts";

const themes: readonly theme[] = ["day", "sun", "night"];

function line_state(all: page): TemplateResult {
  const now = all.now();
  if (all.world.is_heard(now)) return html`<span id="line" class="line good">live</span>`;
  const words = Number.isFinite(all.world.silent_ms(now)) ? `not heard: ${age_words(all.world.silent_ms(now))}` : "not heard yet";
  return html`<span id="line" class="line bad" role="status">${words}</span>`;
}

function top_bar(all: page): TemplateResult {
  const progress = all.world.get("progress");
  const health = all.world.get("health");
  const worst = health?.parts[0];
  const share = progress === undefined || progress.items === 0 ? 0 : progress.items_done / progress.items;
  return html`<header class="bar">
    <h1>godwit</h1>${line_state(all)}
    <span class="health ${health?.worst === "red" ? "bad" : health?.worst === "yellow" ? "warn" : "good"}" id="health"
      title="health of the program">${health === undefined ? "health –" : health.worst === "green" ? "all is well" : `${worst?.part}: ${worst?.reason}`}</span>
    <span class="progress" id="progress">${progress === undefined || progress.mission_id === "" ? "no mission"
      : html`${progress.items_done} of ${progress.items} items <meter min="0" max="1" value=${share} aria-label="items done"></meter>`}</span>
    <span class="grow"></span>
    ${all.me === undefined ? nothing : html`<span class="me" id="me">${all.me.name} <small>${all.me.role}</small></span>
      <button class="plain" type="button" @click=${() => void all.log_out()}>log out</button>`}
    <a class="plain" id="documents" href="/docs/" target="_blank" rel="noopener">docs</a>
    <button class="plain" type="button" id="mute" aria-pressed=${all.is_muted} @click=${() => all.set_muted(!all.is_muted)}>${all.is_muted ? "sound off" : "sound on"}</button>
    <span class="themes" role="group" aria-label="Light">${themes.map((each) => html`<button class="plain" type="button" id="theme-${each}"
      aria-pressed=${all.theme === each} @click=${() => all.set_theme(each)}>${each}</button>`)}</span>
  </header>`;
}

function alarm_list(all: page): TemplateResult {
  return html`<div class="alarms" id="alarms" role="alert">${repeat(all.alarms.list, (each) => each.key, (each) => html`<p class="alarm">
    <time>${time_words(each.at_ms)}</time> <span>${each.words}</span>
    <button class="act small" type="button" @click=${() => { all.alarms.see(each.key); all.draw(); }}><span>Seen</span></button></p>`)}</div>`;
}

export function page_view(all: page): TemplateResult {
  const left_out = left_out_words(all.objects.seen);
  const is_silent = all.world.session !== "" && !all.world.is_heard(all.now());
  return html`${top_bar(all)}
    <main class=${is_silent ? "silent" : ""}>
      <section class="map-side" aria-label="Map"><div id="map"></div>
        <div class="north" aria-hidden="true"><b>N</b></div>
        <div class="map-keys"><button class="plain" type="button" id="see-all" @click=${() => all.see_all()}>all <kbd aria-hidden="true">f</kbd></button>
          <button class="plain" type="button" id="follow" @click=${() => all.follow()}>follow <kbd aria-hidden="true">v</kbd></button></div>
        ${left_out === "" ? nothing : html`<p class="map-note" id="objects-left-out">${left_out}</p>`}
        ${alarm_list(all)}</section>
      <aside class="panel" aria-label="Flight">${authority_block(all)}${phase_block(all)}${instruments(all)}${command_panel(all)}</aside>
      ${drawer_view(all)}
    </main>${login_view(all)}`;
}
