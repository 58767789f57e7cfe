// What the vehicle says of its mission, and what of it counts.
//
//   MISSION_CURRENT                       within settling_ns                   later
//   of our plan, at the start             arms                                 arms
//   of our plan, ahead of where it was    nothing                              armed: moves on; else not_at_start
//   of our plan, before where it was      nothing                              nothing: it is late
//   sequence not in the plan              nothing                              nothing
//   of another plan, or of none           nothing                              paused: foreign plan
//
//   MISSION_ITEM_REACHED                  nothing                              armed: of the item where it is or that
//                                                                              it has just left, once; not the one
//                                                                              that was told last before a start
//
// A REACHED does not say of which plan it is: one of a plan that a foreign hand has uploaded passes for ours until the
// next MISSION_CURRENT tells of that plan.
//
// While an upload is under way, a vehicle with plan ids goes on with the old plan: MISSION_CURRENT with another id is
// held until the upload is resolved, and a REACHED waits until the old id is seen again. A vehicle without them is held
// in place: its MISSION_CURRENT means nothing then, a REACHED is of what it flew before. While a start is under way,
// MISSION_CURRENT that may come of it is held, and a REACHED after it counts nothing. Thread: one at a time.
#pragma once

#include "actors/executor/progress/decision_context.hpp"

namespace godwit::executor::progress {

void take(decision_context& t, const current_told& what);
void take(decision_context& t, const reached_told& what);
void take(decision_context& t, const came_down& what);
void take(decision_context& t, const other_plan_found& what);
void take(decision_context& t, const vehicle_rebooted& what);

// No intent is under way any more: what was held is looked at.
void release_held(decision_context& t);

// Nothing counts until the next generation.
void pause(decision_context& t, pause_reason why);

} // namespace godwit::executor::progress
