// How a vehicle moves at an instant. Thread: values.
#pragma once

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

} // namespace godwit::sim
