// How far the vehicle is with the surveys of its plan, for scan_controller; and whether a mission is one in which
// points of interest are looked for. Pure. Thread: any.
#pragma once

#include <optional>

#include "actors/executor/settings.hpp"
#include "actors/executor/state.hpp"
#include "messages/scan_controller/view.hpp"

namespace godwit::executor {

// Of the mission that is there.
[[nodiscard]] bool scans(const state& s, scan_policy wanted);

// In flight, with a plan that the vehicle has begun; nothing else.
[[nodiscard]] std::optional<scan_controller::survey_progress> survey_progress_of(const state& s);

} // namespace godwit::executor
