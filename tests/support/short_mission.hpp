// The mission that tests of whole flights fly, around the home of the simulated vehicles.
#pragma once

#include <string>

#include "messages/mission/document.hpp"
#include "programs/godwit-sim/vehicle/personality.hpp"

namespace godwit::tests {

// Takes off, flies three waypoints, returns; a rover only drives.
[[nodiscard]] mission::document short_mission(sim::personality who);
// The n-th waypoint around there.
[[nodiscard]] mission::item place(const std::string& id, double north_m, double east_m, double up_m);

} // namespace godwit::tests
