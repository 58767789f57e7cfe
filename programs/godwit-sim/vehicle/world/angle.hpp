// Angles brought into range. Thread: pure.
#pragma once

#include <cmath>
#include <numbers>

namespace godwit::sim {

constexpr double degree = std::numbers::pi / 180; // in radians

// 0 to 360, without 360.
[[nodiscard]] inline double heading_of(double angle_deg) {
  const double turned = std::fmod(angle_deg, 360.0);
  const double heading_deg = turned < 0 ? turned + 360 : turned;
  return heading_deg < 360 ? heading_deg : 0; // what is a hair below 0 becomes 360 when 360 is added
}

// -180 to 180: how far to turn, to the right if positive.
[[nodiscard]] inline double turn_of(double angle_deg) { return std::remainder(angle_deg, 360.0); }

} // namespace godwit::sim
