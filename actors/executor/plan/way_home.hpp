// The plan of a vehicle that is called home and must not fly there straight: over the turns, and from the last one by
// the autopilot's own return, which lands where it always does. A rover ends at a waypoint there, after which those
// that drive by the MAVLink text hold. Where the autopilot's return leads elsewhere (TO), it ends there with a landing.
// No item of the mission belongs to it. Thread: pure.
#pragma once

#include <optional>
#include <vector>

#include "actors/executor/plan/flight_plan.hpp"
#include "actors/executor/plan/setting.hpp"
#include "messages/mission/item.hpp"

namespace godwit::executor::plan {

[[nodiscard]] flight_plan way_home(const std::vector<mission::waypoint>& turns, const plan_setting& setting,
                                   const std::optional<mission::position>& to = std::nullopt);

} // namespace godwit::executor::plan
