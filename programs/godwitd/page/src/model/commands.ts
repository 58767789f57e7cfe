// What an operator can say, and the body in which it is said (docs/operator_api.md). Pure.
import type { place, problem } from "./messages.ts";

export type command_name = "start" | "pause" | "resume" | "come_home" | "hand_back" | "acknowledge" | "check" | "go_to" |
  "cancel" | "insert" | "end_flight" | "pull";

export interface command_row {
  name: command_name;
  label: string;
  key: string; // on the keyboard; empty: none
  moves: boolean; // or may: it is held down to confirm
  is_stop: boolean; // every operator may say it, with and without control
  hint: string;
}

export const command_rows: readonly command_row[] = [
  { name: "start", label: "Start", key: "s", moves: true, is_stop: false, hint: "fly the plan that is ready; of a mission that is over: prepare it again" },
  { name: "pause", label: "Pause", key: "p", moves: false, is_stop: true, hint: "hold where it is" },
  { name: "resume", label: "Resume", key: "r", moves: true, is_stop: false, hint: "continue the mission" },
  { name: "come_home", label: "Come home", key: "h", moves: true, is_stop: true, hint: "return, and end the mission" },
  { name: "hand_back", label: "Hand back", key: "b", moves: true, is_stop: false,
    hint: "after a takeover or a failsafe: release the vehicle to the mission" },
  { name: "cancel", label: "Cancel go-to", key: "x", moves: true, is_stop: false,
    hint: "the mission continues with its first item that is not done" },
];

export function command_row_of(name: command_name): command_row | undefined {
  return command_rows.find((each) => each.name === name);
}

export interface command_body {
  id: string;
  command: command_name;
  valid_until: string;
  state?: string;
  report?: number;
  place?: place & { altitude_m: number };
  after?: string;
}

export const validity_ms = 8_000; // a command that comes later is not meant any more

// Of what crypto.getRandomValues fills: pages under a plain http:// name have no randomUUID.
export function command_id(who: string, random: Uint8Array): string {
  const hex = [...random].map((each) => each.toString(16).padStart(2, "0")).join("");
  const name = who.replace(/[^a-z0-9_.-]/gi, "").slice(0, 24);
  return `${name}-${hex}`;
}

// GODWIT_MS: now, by the clock of godwitd.
export function body_of(command: command_name, id: string, state: string, godwit_ms: number,
                        more: Pick<command_body, "report" | "place" | "after"> = {}): command_body {
  const result: command_body = { id, command, valid_until: new Date(godwit_ms + validity_ms).toISOString(), ...more };
  const needs_state = command !== "pause" && command !== "come_home" && command !== "check" && command !== "pull";
  if (needs_state) result.state = state;
  return result;
}

// To a place on the map: a click or a point of interest names it, the way is shown, and a held button confirms it.
export type pointed_command = "go_to" | "insert";

export interface pointed_row {
  name: pointed_command;
  label: string;
  key: string;
  confirm: string;
  hint: string;
}

export const pointed_rows: readonly pointed_row[] = [
  { name: "go_to", label: "Go to…", key: "g", confirm: "Fly there", hint: "fly to a place on the map, and stay there" },
  { name: "insert", label: "Insert…", key: "i", confirm: "Insert", hint: "one more waypoint in the mission, which continues after it" },
];

export function pointed_row_of(name: pointed_command): pointed_row {
  return pointed_rows.find((each) => each.name === name) as pointed_row;
}

const beginnings: Record<string, string> = {
  stale: "The flight stands otherwise by now: look again. ",
  late: "It came too late, and nothing was done. ",
  no_control: "You do not have control. ",
  wrong_role: "Your role may not do this. ",
  unknown: "What became of it is not known: look at the flight before you send it again. ",
};

// What is said beside the button.
export function refusal_words(why: problem): string {
  return `${beginnings[why.verdict ?? ""] ?? ""}${sentence(why.detail)}`.trim();
}

function sentence(text: string): string {
  return text === "" ? "" : text.slice(0, 1).toUpperCase() + text.slice(1) + (/[.!?]$/.test(text) ? "" : ".");
}
