// The vehicle holds the new plan: one step from the old to the new, and none in between.
//
// In this order: what the vehicle was seen to leave in the old plan is resolved; the last report that counts goes into
// the answer to the assignment; generation, map and plan id are replaced, and from now on all that belongs to an older
// generation is dropped; items of the same revision that the new plan leaves out are skipped; MISSION_CURRENT that came
// before the proof is looked at. The caller commits all of it in one transaction. Thread: one at a time.
#pragma once

#include <cstdint>
#include <optional>

#include "actors/executor/progress/decision_context.hpp"

namespace godwit::executor::progress {

// An upload is pending. PLAN_ID: the vehicle's for the new plan; absent or 0: not known, or it keeps none.
void cut_over(decision_context& t, std::optional<std::uint32_t> plan_id);

} // namespace godwit::executor::progress
