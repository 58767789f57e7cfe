// Flights for the tests of the core: what they begin with, and what is asked of them. Thread: one.
#pragma once

#include <algorithm>
#include <vector>

#include "tests/actors/failsafe/flight_world.hpp"

namespace godwit::tests {

inline constexpr failsafe::vehicle_class classes[] = {
    failsafe::vehicle_class::multirotor, failsafe::vehicle_class::fixed_wing, failsafe::vehicle_class::rover};

using these = std::vector<failsafe::action>;

// What was sent.
inline these actions_of(const flight_world& world) {
  these result;
  for (const auto& each : world.sent)
    result.push_back(each.what);
  return result;
}

// On its mission, 100 m from the sides of a fence that is 120 m high.
inline flight_world fenced(failsafe::vehicle_class what = failsafe::vehicle_class::multirotor) {
  flight_world world(what);
  world.set_fences({fence_of(mission::fence_kind::inclusion, square(100), {}, 120)});
  world.run_s(10);
  return world;
}

// A steady gauge that fell slowly.
inline void drain_to(flight_world& world, int percent) {
  while (world.battery_percent > percent) {
    world.battery_percent = std::max(percent, world.battery_percent - 15);
    world.run_s(1);
  }
  world.run_s(7);
}

} // namespace godwit::tests
