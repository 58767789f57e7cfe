// An upload from the intent to its end.
//
//                 accepted                                       matches pending
//   pending ───────────────────────────> cut-over <──────────────────────────────┐
//      │  │ unchanged                                                            │
//      │  └────────────────────────────> failed <── the old plan id ──┐          │
//      │                                    ^                         │          │
//      │ unknown, or a restart              └── matches before ──┐    │          │
//      └────────────> look_at_vehicle ───────────────────────────┼────┴──> read_plan_back
//                                                                │               │
//                              foreign plan: paused <── other ───┴───────────────┘
//
// Failed: the plan before stays in force, and an assignment is rejected. An answer to a question that is settled, or
// was never asked, changes nothing. Thread: one at a time.
#pragma once

#include "actors/executor/progress/turn.hpp"

namespace godwit::executor::progress {

void take(turn& t, const upload_intended& what);
void take(turn& t, const upload_ended& what);
void take(turn& t, const vehicle_looked_at& what);
void take(turn& t, const plan_read_back& what);

} // namespace godwit::executor::progress
