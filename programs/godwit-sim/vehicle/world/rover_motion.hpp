// How a rover drives: it turns at most so fast, speeds up and brakes at most so hard, and goes where it points to.
// Thread: pure.
#pragma once

#include "programs/godwit-sim/vehicle/world/body.hpp"

namespace godwit::sim {

struct rover_limits {
  double acceleration_mps2 = 1;
  double turn_rate_deg_s = 45;
};

struct drive_order {
  course way; // to the place, from where it is
  double speed_mps = 0;
  bool stops = false; // there
};

// One step towards the place. It turns towards it, and goes so slowly that the circle on which it can turn leads
// there: who is fast and near would else circle a place for ever.
void drive(body& rover, const rover_limits& limits, const drive_order& order, double step_s);
// One step of standing, or of coming to a stop.
void brake(body& rover, const rover_limits& limits, double step_s);

} // namespace godwit::sim
