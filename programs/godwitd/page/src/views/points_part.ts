// What the camera shows now, and the points of interest: those that somebody has to decide about, with the time that is
// left, and those that were confirmed. Nothing moves by a decision; to fly there is a command of its own.
import { html, nothing } from "lit";
import { repeat } from "lit/directives/repeat.js";
import type { TemplateResult } from "lit";
import { old_picture_ms } from "../camera.ts";
import { distance_m } from "../model/geometry.ts";
import type { place, point_of_interest, points_update } from "../model/messages.ts";
import { distance_words, plain } from "../model/words.ts";
import type { page } from "../page.ts";
import { refusal, why_not } from "./command_panel.ts";

function picture_part(all: page): TemplateResult {
  const { camera } = all;
  const age_ms = camera.age_ms(all.now());
  const is_old = camera.has_picture() && age_ms > old_picture_ms;
  const words = camera.has_picture() ? `picture ${(age_ms / 1000).toFixed(1)} s old` : "";
  return html`<figure class="camera ${is_old ? "old" : ""} ${camera.has_picture() ? "" : "none"}">
    <canvas id="camera" width="320" height="180" role="img" aria-label="What the camera shows"></canvas>
    <figcaption id="camera-age">${words === "" ? nothing : html`<span class=${is_old ? "age" : ""}>${words}</span>`}
      ${camera.why_none === "" ? nothing : html`<span id="camera-why">No picture: ${camera.why_none}</span>`}
      ${words === "" && camera.why_none === "" ? "The camera is asked…" : nothing}</figcaption></figure>`;
}

const place_of = (point: point_of_interest): place => ({ latitude: point.latitude_deg, longitude: point.longitude_deg });

// What the camera saw of it, where there is a picture.
function cut_out(point: point_of_interest): TemplateResult | typeof nothing {
  if (!point.has_picture) return nothing;
  const show = (shown: boolean) => (event: Event) => { (event.target as HTMLElement).hidden = !shown; };
  return html`<img class="cut-out" src="/api/v1/points/${point.number}/picture" alt="Point ${point.number}" hidden
      @load=${show(true)} @error=${show(false)}>`;
}

function what_part(all: page, point: point_of_interest): TemplateResult {
  const at = all.vehicle();
  return html`<td><b>${point.number}</b></td><td>${cut_out(point)}</td><td>${plain(point.class_group)}${point.has_moved ? html` <small>has moved</small>` : nothing}</td>
    <td>${Math.round(100 * point.confidence)} %</td><td>${at === undefined ? "–" : distance_words(distance_m(at, place_of(point)))}</td>`;
}

function open_row(all: page, point: point_of_interest): TemplateResult {
  const reason = why_not(all, false);
  const what = `point-${point.number}`;
  const left_s = Math.max(0, Math.ceil((point.decide_until_ms - all.world.godwit_ms(all.now())) / 1000));
  const button = (decision: "confirm" | "decline", label: string) => html`<button class="act small" type="button" id="${decision}-${point.number}"
      ?disabled=${reason !== "" || all.commander.under_way.has(what)} title=${reason || (decision === "confirm" ? "of interest; nothing flies there by it" : "of no interest: such things there are not shown again")}
      @click=${() => void all.commander.decide(point.number, decision)}><span>${label}</span></button>`;
  return html`<tr class="open" data-point=${point.number}>${what_part(all, point)}<td class=${left_s <= 15 ? "age" : ""}>${left_s} s left</td>
    <td><div class="row">${button("confirm", "Confirm")}${button("decline", "Decline")}</div>${refusal(all, what)}</td></tr>`;
}

function confirmed_row(all: page, point: point_of_interest): TemplateResult {
  const reason = why_not(all, false);
  return html`<tr data-point=${point.number}>${what_part(all, point)}<td>confirmed by ${point.by}</td>
    <td><button class="act small" type="button" id="visit-${point.number}" ?disabled=${reason !== ""} title=${reason || "shows the way of a waypoint there; it is confirmed beside the commands"}
      @click=${() => { all.commander.begin_pointing("insert", place_of(point)); all.draw(); }}><span>Fly there…</span></button></td></tr>`;
}

function summary(points: points_update | undefined): string {
  if (points === undefined || (!points.is_looking && points.confirmed.length === 0))
    return "Nobody looks for points of interest now: that is done while a mission with a survey is flown.";
  if (points.shown.length === 0)
    return points.waiting > 0 ? `None is shown now; ${points.waiting} wait for their turn.` : "None waits for a decision.";
  return points.waiting > 0 ? `${points.waiting} more wait for their turn.` : "";
}

export function points_part(all: page): TemplateResult {
  const points = all.world.get("points");
  const words = summary(points);
  return html`<div class="points-side">${picture_part(all)}
    <div>${words === "" ? nothing : html`<p class="empty" id="points-summary">${words}</p>`}
      <table class="rows"><caption class="hidden">Points of interest</caption><tbody>
        ${repeat(points?.shown ?? [], (each) => each.number, (each) => open_row(all, each))}
        ${repeat(points?.confirmed ?? [], (each) => each.number, (each) => confirmed_row(all, each))}</tbody></table></div>
  </div>`;
}
