// What the motions of all bodies have in common. Thread: pure.
#pragma once

#include <algorithm>

#include "programs/godwit-sim/vehicle/world/body.hpp"

namespace godwit::sim {

constexpr double gravity_mps2 = 9.80665;
// Less than what a body can do, so that it stops before the place and not beyond it.
constexpr double braking_margin = 0.8;

// By MOST at the most.
[[nodiscard]] inline double towards(double value, double wanted, double most) {
  return value + std::clamp(wanted - value, -most, most);
}

// Brings the climb towards WANTED_MPS, and rises or sinks.
inline void climb_towards(body& it, double wanted_mps, double acceleration_mps2, double step_s) {
  const double before_mps = it.climb_mps;
  it.climb_mps = towards(before_mps, wanted_mps, acceleration_mps2 * step_s);
  it.where.altitude_m += (before_mps + it.climb_mps) / 2 * step_s;
}

} // namespace godwit::sim
