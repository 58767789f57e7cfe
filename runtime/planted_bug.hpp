// Bugs that are planted on purpose, so that whoever flies missions in drills shows that each of them would be found.
//
// Only a build with GODWIT_PLANTED_BUGS has them: the environment variable GODWIT_PLANTED_BUG names the one that acts
// in the process. In any other build is_planted() is the constant false, and nothing is left of it.
// scripts/planted_bugs builds, flies and counts. Thread: any.
#pragma once

#include "io/fields/field_table.hpp"

#ifdef GODWIT_PLANTED_BUGS
#include <cstdlib>
#endif

namespace godwit::runtime {

enum class planted_bug {
  none,
  forget_gate,                 // an order goes out before its reason is on the disk
  swap_cut_over,               // a new plan counts before the vehicle holds it
  reuse_idempotency_key,       // two reports have one key
  restart_twice,               // a crashed actor has two successors
  drop_redelivery,             // the message that crashed its handler is forgotten
  old_plans_progress,          // what is said of any plan counts for the newest
  act_after_takeover,          // a person has the vehicle, and the task goes on
  skip_look,                   // a new incarnation does not look at the vehicle first
  clear_while_armed,           // a station's clear reaches the vehicle whatever it does
  forget_fence_revision,       // a plan that is changed is not guarded by its fences
  lose_outbox_row,             // the report after one that was delivered is gone
  report_before_commit,        // a durable effect goes out before its event is on the disk
  repeat_start_over_person,    // a start is said again although a person has the vehicle
  believe_late_frame,          // nobody waits for what was said of the plan before
  complete_on_foreign_landing, // who lands elsewhere has completed the mission
  let_stale_order_out          // an order goes out however long it has waited
};

GODWIT_ENUM_NAMES(planted_bug, none, forget_gate, swap_cut_over, reuse_idempotency_key, restart_twice, drop_redelivery,
                  old_plans_progress, act_after_takeover, skip_look, clear_while_armed, forget_fence_revision,
                  lose_outbox_row, report_before_commit, repeat_start_over_person, believe_late_frame,
                  complete_on_foreign_landing, let_stale_order_out);

#ifdef GODWIT_PLANTED_BUGS
[[nodiscard]] inline planted_bug bug_of_process() {
  static const planted_bug which = [] {
    const char* name = std::getenv("GODWIT_PLANTED_BUG");
    return io::value_of<planted_bug>(name == nullptr ? "none" : name).value();
  }();
  return which;
}
[[nodiscard]] inline bool is_planted(planted_bug which) { return which == bug_of_process(); }
#else
[[nodiscard]] constexpr bool is_planted(planted_bug) { return false; }
#endif

} // namespace godwit::runtime

// NAME: a value of planted_bug. True: it acts here.
#define GODWIT_PLANTED(name) ::godwit::runtime::is_planted(::godwit::runtime::planted_bug::name)
