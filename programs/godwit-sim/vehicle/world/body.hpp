// How a vehicle moves at an instant. Thread: values.
#pragma once

#include <algorithm>

#include "programs/godwit-sim/vehicle/world/position.hpp"

namespace godwit::sim {

struct body {
  position where;
  double heading_deg = 0;      // 0 to 360
  double ground_speed_mps = 0; // along track_deg
  double track_deg = 0;        // of the motion over ground; a rover's is its heading
  double climb_mps = 0;        // up
  double roll_rad = 0;
  double pitch_rad = 0;
  double turn_rate_rad_s = 0; // of the heading
  double throttle = 0;        // 0 to 1
};

// What the motions of all bodies have in common. Thread: pure.
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
