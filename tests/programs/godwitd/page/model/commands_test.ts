import assert from "node:assert/strict";
import { test } from "node:test";
import { alarms } from "../../../../../programs/godwitd/page/src/model/alarms.ts";
import { body_of, command_id, command_rows, refusal_words, validity_ms } from "../../../../../programs/godwitd/page/src/model/commands.ts";
import type { text } from "../../../../../programs/godwitd/page/src/model/messages.ts";
import { age_words, authority_words } from "../../../../../programs/godwitd/page/src/model/words.ts";
import { world } from "../../../../../programs/godwitd/page/src/model/world.ts";

test("all that moves the vehicle is held down; a hold is not", () => {
  for (const each of command_rows) assert.equal(each.moves, each.name !== "pause", each.name);
});

test("a command has an id that fits, a deadline by godwit's clock, and the state that was seen", () => {
  const id = command_id("anna with a very long name <b>", new Uint8Array(12).fill(255));
  assert.match(id, /^[a-z0-9_.-]+-(ff){12}$/);
  assert.ok(id.length <= 64);
  const body = body_of("start", id, "ready/none/m/1/1/0", 1_000_000);
  assert.equal(Date.parse(body.valid_until), 1_000_000 + validity_ms);
  assert.equal(body.state, "ready/none/m/1/1/0");
  for (const each of ["pause", "come_home", "check", "pull"] as const)
    assert.equal("state" in body_of(each, id, "x", 1), false, each);
});

test("a refusal says what it means to who has pressed the button", () => {
  assert.equal(refusal_words({ status: 423, verdict: "no_control", detail: "bob has control" }), "You do not have control. Bob has control.");
  assert.match(refusal_words({ status: 504, verdict: "unknown", detail: "" }), /look at the flight before you send it again/);
  assert.equal(refusal_words({ status: 409, verdict: "refused", detail: "No flight is under way." }), "No flight is under way.");
});

test("who has the vehicle has words of its own, and a name that is not known is said as it is", () => {
  for (const each of ["godwit", "person", "failsafe", "autopilot_end", "autopilot_failsafe", "unclear", "nobody"])
    assert.notEqual(authority_words(each).words, each === "godwit" ? "" : each, each);
  assert.equal(authority_words("somebody").words, "somebody");
});

test("an age is said in words", () => {
  assert.equal(age_words(2_900), "2 s old");
  assert.equal(age_words(61_000), "1 min 1 s old");
  assert.equal(age_words(Infinity), "never heard");
});

function heard(holder: string, phase = "flying"): world {
  const all = new world();
  all.is_open = true;
  const say = (topic: string, data: object) => all.take({ topic, number: 1, at_ms: 1, data } as unknown as text, 0);
  all.take({ topic: "stream", data: { session: "1" } }, 0);
  say("flight", { phase, cause: phase === "paused" ? "taken_over" : "none", sentence: "", in_flight: true, is_armed: true,
    mode: "mission", preflight_report: 0, state: "" });
  say("authority", { holder });
  return all;
}

test("what needs a person is raised once, stays until it is seen, and is raised again when it comes again", () => {
  const all = new alarms();
  assert.equal(all.look(heard("godwit"), 0), false);
  assert.equal(all.look(heard("person", "paused"), 0), true);
  assert.equal(all.look(heard("person", "paused"), 0), false);
  assert.equal(all.list.length, 2);
  all.see_all();
  assert.equal(all.look(heard("person", "paused"), 0), false);
  assert.equal(all.look(heard("godwit"), 0), false);
  assert.equal(all.look(heard("failsafe"), 0), true);
  assert.equal(all.list.length, 1);
});

test("a godwitd that is not heard is an alarm", () => {
  const all = new alarms();
  const before = heard("godwit");
  assert.equal(all.look(before, 1_000), false);
  assert.equal(all.look(before, 2_500), true);
});
