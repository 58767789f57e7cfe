// The parts of a manoeuvre. Thread: values.
#pragma once

#include <variant>
#include <vector>

#include "programs/godwit-sim/vehicle/world/position.hpp"

namespace godwit::sim {

struct climb_leg { // straight up or down, a fixed wing straight on; who stands on the ground takes off
  double altitude_m = 0;
};
struct go_leg { // done within the radius, and a multirotor at the altitude; a fixed wing also when it has passed it
  position to;
  double radius_m = 0;
  bool stops = false;
  double speed_mps = 0; // 0: what the pace says
  double circle_m = 0;  // of a fixed wing that stays there; negative: to the left; 0: its own
};
struct land_leg {};     // straight down to the ground; a fixed wing straight on
struct touch_down_leg { // fixed wing: down a straight path to this place on the ground
  position to;
};
struct wait_leg { // standing, at a hover or on circles
  double left_s = 0;
};
struct stay_leg {}; // the same, with no end

using leg = std::variant<climb_leg, go_leg, land_leg, touch_down_leg, wait_leg, stay_leg>;
using leg_list = std::vector<leg>;

// Nobody flies lower than this above the ground but to land: an altitude of 0 is no landing.
constexpr double min_flight_height_m = 1;

} // namespace godwit::sim
