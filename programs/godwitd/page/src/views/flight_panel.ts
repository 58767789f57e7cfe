// The instruments: who has the vehicle, the phase and why, and what is measured, each with its age when it is old.
import { html, nothing } from "lit";
import type { TemplateResult } from "lit";
import type { topic } from "../model/messages.ts";
import { age_words, authority_words, fix_words, number_words, phase_tone, plain, traffic_words, way_home_words } from "../model/words.ts";
import { old_ms } from "../model/world.ts";
import type { page } from "../page.ts";

// An instrument: its value, or how old it is.
function instrument(all: page, from: topic, label: string, value: string, unit: string, more = "", is_wrong = false): TemplateResult {
  const age = all.world.age_ms(from, all.now());
  const is_old = age > old_ms;
  return html`<div class="instrument ${is_old ? "old" : ""} ${is_wrong ? "wrong" : ""}" data-value=${label}>
    <dt>${label}</dt>
    <dd><span class="value">${value}</span> <span class="unit">${unit}</span>
      ${more === "" ? nothing : html`<span class="more">${more}</span>`}
      ${is_old ? html`<span class="age">${age_words(age)}</span>` : nothing}</dd>
  </div>`;
}

export function authority_block(all: page): TemplateResult {
  const holder = all.world.get("authority")?.holder;
  const { words, tone } = authority_words(holder);
  const is_old = !all.world.is_heard(all.now());
  return html`<section id="authority" class="authority ${tone} ${is_old ? "old" : ""}" aria-label="Who has the vehicle">
    <small>who has the vehicle</small><strong>${words}</strong>
    ${is_old ? html`<span class="age">${holder === undefined ? "" : `was so ${age_words(all.world.silent_ms(all.now())).replace(" old", " ago")}`}</span>` : nothing}
  </section>`;
}

// A sentence begins with the phase, which stands above it in large letters.
function without_phase(sentence: string, phase: string): string {
  return sentence === phase ? "" : sentence.startsWith(`${phase}: `) ? sentence.slice(phase.length + 2) : sentence;
}

export function phase_block(all: page): TemplateResult {
  const flight = all.world.get("flight");
  const is_old = !all.world.is_heard(all.now());
  const cause = flight !== undefined && flight.cause !== "none" && flight.cause !== "" ? `: ${plain(flight.cause)}` : "";
  return html`<section id="phase" class="phase ${phase_tone(flight?.phase)} ${is_old ? "old" : ""}" aria-label="Phase of the flight">
    <strong>${flight === undefined ? "–" : plain(flight.phase) + cause}</strong>
    <p>${flight === undefined ? "Nothing was heard of the flight yet." : without_phase(flight.sentence, flight.phase)}</p>
  </section>`;
}

export function instruments(all: page): TemplateResult {
  const world = all.world;
  const position = world.get("position");
  const battery = world.get("battery");
  const gps = world.get("gps");
  const flight = world.get("flight");
  const charge = battery?.remaining_percent ?? null;
  const home = way_home_words(world.get("way_home"));
  const traffic = traffic_words(world.get("traffic"));
  return html`<dl class="instruments" id="instruments">
    ${instrument(all, "position", "Altitude", number_words(position?.altitude_m, 1), "m", "above home")}
    ${instrument(all, "position", "Speed", number_words(position?.ground_speed_mps, 1), "m/s", "over ground")}
    ${instrument(all, "position", "Climb", number_words(position?.climb_mps, 1), "m/s")}
    ${instrument(all, "position", "Heading", number_words(position?.heading_deg, 0), "°")}
    ${instrument(all, "battery", "Battery", number_words(charge, 0), "%",
      battery === undefined ? "" : `${number_words(battery.voltage_v, 1)} V ${number_words(battery.current_a, 1)} A`)}
    ${instrument(all, "way_home", "Way home", home.value, home.unit, home.more, home.is_short)}
    ${instrument(all, "gps", "GPS", gps === undefined ? "–" : fix_words(gps.fix), "",
      gps === undefined ? "" : `${gps.satellites ?? "–"} satellites${gps.accuracy_m === null ? "" : `, ±${number_words(gps.accuracy_m, 1)} m`}`)}
    ${instrument(all, "flight", "Mode", flight === undefined || flight.mode === "" ? "–" : plain(flight.mode), "",
      flight === undefined ? "" : flight.is_armed ? "armed" : "disarmed")}
    ${link_instrument(all)}
    ${world.get("traffic") === undefined ? nothing : instrument(all, "traffic", "Aircraft", traffic.value, "", traffic.more, traffic.is_close)}
  </dl>`;
}

function link_instrument(all: page): TemplateResult {
  const link = all.world.get("link");
  const is_well = link?.phase === "connected";
  const heard = all.world.said_ms_ago("position", all.now());
  return html`<div class="instrument ${is_well ? "" : "wrong"} ${all.world.is_heard(all.now()) ? "" : "old"}" data-value="Link">
    <dt>Link</dt>
    <dd><span class="value">${link === undefined ? "–" : plain(link.phase)}</span>
      <span class="more">${link?.reason ? link.reason : `position ${Number.isFinite(heard) ? `${(heard / 1000).toFixed(1)} s ago` : "never heard"}`}</span></dd>
  </div>`;
}
