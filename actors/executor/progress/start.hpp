// A MISSION_START or set-current, from the intent to its answer. Accepted, it opens a new generation of the plan that
// is there; items that it jumps over are skipped. A vehicle that restarted or was aborted counts again from then on; a
// foreign plan does not become ours by it. One that is flown and that nobody here has started counts from the item at
// which it was found. Thread: one at a time.
#pragma once

#include "actors/executor/progress/decision_context.hpp"

namespace godwit::executor::progress {

void take(decision_context& t, const start_intended& what);
void take(decision_context& t, const found_begun& what);
void take(decision_context& t, const start_ended& what);

} // namespace godwit::executor::progress
