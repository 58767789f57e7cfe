// The phases of a flight. What leads from one to another: flight/phase_table.hpp.
//
//   disconnected ──> connected ──> preflight ──> uploading ──> ready ──> starting ──> flying ──> landing ──┬─> aborted
//        ^               │  ^            │            │          │           │           │          │      │
//        └── link down ──┴──┼────────────┘            │          │           │           │          │      v
//                           ├──── another mission, revision or assignment ───┘           │          │  post_flight
//                           └──── the next plan of the mission ──────────────────────────┼──────────┤      │
//                                                                                        │          v      v
//                                                                                        ├─────> pausing  done
//                                                                                        v          v
//                       paused <── a pilot, a failsafe, an operator, what could not be done ────────┘
//
// Paused has a cause: what ends it depends on that. One that needs a hand-back also stands in post_flight and done.
// Thread: constants.
#pragma once

#include "io/fields/field_table.hpp"

namespace godwit::executor {

enum class phase {
  disconnected, // no autopilot is heard
  connected,    // an autopilot, and no mission
  preflight,    // the checks are run until they pass
  uploading,    // the plan goes to the vehicle
  ready,        // it is there, and waits for the start
  starting,
  flying,
  pausing,     // an operator has commanded it to hold, and it is not seen to: it still flies the plan, or lands
  landing,     // the plan is flown; the vehicle comes down
  post_flight, // what is owed to the service is delivered
  done,
  paused, // godwit sends nothing on its own until the cause is gone
  aborted // the mission is over before its end
};

GODWIT_ENUM_NAMES(phase, disconnected, connected, preflight, uploading, ready, starting, flying, pausing, landing,
                  post_flight, done, paused, aborted);

// The mission is over, and all that was owed for it is done.
[[nodiscard]] constexpr bool is_at_rest(phase now) { return now == phase::done || now == phase::aborted; }

// Of a flight that nothing has paused.
[[nodiscard]] constexpr bool is_on_way(phase now) {
  return now == phase::flying || now == phase::pausing || now == phase::landing;
}

// It is flown no more; something may be owed for it.
[[nodiscard]] constexpr bool is_over(phase now) { return now == phase::post_flight || is_at_rest(now); }

enum class pause_cause {
  none,
  asked,              // an operator said so
  taken_over,         // a person has the vehicle, or has ended the flight: until an operator hands it back
  failsafe,           // a failsafe acts: until an operator hands it back
  autopilot_failsafe, // the autopilot's own acts: until an operator hands it back
  vehicle_restarted,  // what the autopilot flew is lost
  foreign_plan,       // the vehicle holds a plan that is not ours
  infeasible_plan,    // the vehicle finds that the plan that was brought to it can not be flown
  not_done,           // a command or an upload failed for good; the reason says which
  restarted,          // godwit was restarted on the ground: nothing begins by itself
  plan_ended          // in the air: the vehicle waits there until it is called home or sent further
};

GODWIT_ENUM_NAMES(pause_cause, none, asked, taken_over, failsafe, autopilot_failsafe, vehicle_restarted, foreign_plan,
                  infeasible_plan, not_done, restarted, plan_ended);

// Only after an operator's word may anything be sent again.
[[nodiscard]] constexpr bool needs_hand_back(pause_cause cause) {
  return cause == pause_cause::taken_over || cause == pause_cause::failsafe || cause == pause_cause::autopilot_failsafe;
}

} // namespace godwit::executor
