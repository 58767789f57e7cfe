// What the executor shows to people who ask: the plan as it is flown, and what the preflight checks have found. Pure.
// Thread: any.
#pragma once

#include <optional>

#include "actors/executor/preflight/bit_state.hpp"
#include "actors/executor/preflight/report.hpp"
#include "actors/executor/state.hpp"
#include "actors/executor/view.hpp"
#include "messages/executor/plan_view.hpp"

namespace godwit::executor {

[[nodiscard]] plan_view plan_view_of(const state& s, const vehicle_view& vehicle);

// LAST: the newest look at the checks; none: there was none yet.
[[nodiscard]] preflight_view preflight_view_of(const preflight::state& s,
                                               const std::optional<preflight::dated_report>& last);

} // namespace godwit::executor
