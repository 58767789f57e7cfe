// The mission that tests of whole flights fly, around the home of the simulated vehicles.
#pragma once

#include <string>

#include "messages/mission/document.hpp"
#include "programs/godwit-sim/vehicle/personality.hpp"

namespace godwit::drill {

// Takes off, flies three waypoints, returns; a rover only drives, and a plane lands at home.
[[nodiscard]] mission::document short_mission(sim::personality who);
// The same around 15 lines of 280 m: some ten times as long.
[[nodiscard]] mission::document long_mission(sim::personality who);
// The n-th waypoint around there.
[[nodiscard]] mission::item place(const std::string& id, double north_m, double east_m, double up_m);
// The same for this vehicle, at 20 m unless it drives: a plane needs more room, and is sent so many times as far.
[[nodiscard]] mission::item place(sim::personality who, const std::string& id, double north_m, double east_m);
// A square around home, this far from it to each side.
[[nodiscard]] mission::geofence fence_around(double metres);
// Take-off, a waypoint, a landing on the way; and after it take-off, a waypoint and home.
[[nodiscard]] mission::document with_landing_on_the_way();
inline constexpr double plane_goes_farther = 5;
// What ends a mission on the ground at home: a return; of a plane, which would circle there for ever, a landing. After
// a place that is not too near.
[[nodiscard]] mission::item way_home(sim::personality who, const std::string& id = "home");

} // namespace godwit::drill
