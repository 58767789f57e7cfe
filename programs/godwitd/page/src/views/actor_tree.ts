// The actors as they are supervised: the guardian above, below it each actor with its incarnation, its restarts, what
// waits in its mailbox, and its last crash. An actor has its row by its name, whatever incarnation it is.
import { html, nothing } from "lit";
import { repeat } from "lit/directives/repeat.js";
import type { TemplateResult } from "lit";
import type { actor_report, status_report } from "../model/messages.ts";
import { plain } from "../model/words.ts";
import type { page } from "../page.ts";

function tone_of(actor: actor_report, is_away: boolean): string {
  if (is_away) return "bad";
  if (actor.wanted && actor.phase !== "running") return "bad";
  return actor.health === "red" ? "bad" : actor.health === "yellow" || actor.last_crash !== "" ? "warn" : actor.wanted ? "good" : "none";
}

function row(all: page, actor: actor_report, status: status_report): TemplateResult {
  const crash = all.crashes.reason_of(actor.name, all.now()); // that the report may not know yet
  const mail = status.mail.find((each) => each.actor === actor.name);
  return html`<li class="actor ${tone_of(actor, crash !== undefined)}" data-actor=${actor.name} role="treeitem" aria-selected="false">
    <b>${actor.name}</b><span>${crash === undefined ? plain(actor.phase) : "crashed"}${actor.wanted ? "" : ", not wanted"}</span>
    <span title="how manieth it is">incarnation ${actor.incarnation}</span>
    <span>${actor.restarts} restart${actor.restarts === 1 ? "" : "s"}</span>
    <span>${mail === undefined ? nothing : html`${mail.waiting} waiting, ${mail.handled} handled`}${mail !== undefined && mail.dead_lettered > 0 ? html`, <b>${mail.dead_lettered} dead letters</b>` : nothing}</span>
    <span class="why">${[actor.health_reason, crash !== undefined ? `crashed: ${crash}` : actor.last_crash === "" ? "" : `last crash: ${actor.last_crash}`].filter((each) => each !== "").join("; ")}</span>
  </li>`;
}

export function actor_tree(all: page): TemplateResult {
  const status = all.drawer.status;
  if (status === undefined) return html`<p class="empty">…</p>`;
  const red = (all.world.get("health")?.parts ?? []).filter((part) =>
    part.health === "red" && !status.actors.some((actor) => actor.name === part.part));
  const groups = [{ name: "essential", words: "essential: without one the process ends" }, { name: "other", words: "replaceable" }] as const;
  return html`<div class="tree" role="tree" aria-label="Actors">
    <p class="root">guardian <span>godwitd ${status.process.version}, ${Math.round(status.process.resident_bytes / 1e6)} MB</span></p>
    ${groups.map((group) => html`<p class="group">${group.words}</p><ul role="group">
      ${repeat(status.actors.filter((each) => each.essential === (group.name === "essential")), (each) => each.name, (each) => row(all, each, status))}</ul>`)}
    ${red.map((part) => html`<p class="actor bad"><b>${part.part}</b> <span class="why">${part.reason}</span></p>`)}
  </div>`;
}
