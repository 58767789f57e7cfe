// An upload from the intent to its end.
//
//                 accepted                                       matches pending
//   pending ───────────────────────────> cut-over <──────────────────────────────┐
//      │  │ unchanged                                   the old plan id,         │
//      │  └────────────────────────────> failed <────── another length ┐         │
//      │                                    ^                          │         │
//      │ unknown, or a restart              └── matches before ──┐     │         │
//      └────────────> look_at_vehicle ───────────────────────────┼─────┴─> read_plan_back
//                                                                │               │
//                              foreign plan: paused <── other ───┴───────────────┘
//
// A plan with the same content has the same id, so that the old id does not resolve it unless the new plan is of
// another length: while the vehicle holds the plan, nobody is told that the upload failed. Failed: the plan before
// stays in force, and an assignment is rejected, unless whoever looked tries it again. An answer to a question that is
// resolved, or was never asked, changes nothing. Thread: one at a time.
#pragma once

#include "actors/executor/progress/decision_context.hpp"

namespace godwit::executor::progress {

void take(decision_context& t, const upload_intended& what);
void take(decision_context& t, const upload_ended& what);
void take(decision_context& t, const vehicle_looked_at& what);
void take(decision_context& t, const plan_read_back& what);

} // namespace godwit::executor::progress
