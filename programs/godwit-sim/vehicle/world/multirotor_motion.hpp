// How a multirotor flies: it accelerates at most so hard, climbs and descends at most so fast, leans into what it does
// and turns its nose to where it flies. Ground and the beginning and end of a flight are not its business. Thread:
// pure.
#pragma once

#include "programs/godwit-sim/vehicle/world/body.hpp"

namespace godwit::sim {

struct multirotor_limits {
  double acceleration_mps2 = 2; // over ground
  double turn_rate_deg_s = 90;  // of the nose
};

struct fly_order {
  course way;            // to the place, from where it is
  double altitude_m = 0; // of the place
  double speed_mps = 0;
  double climb_mps = 0;
  double descent_mps = 0;
  bool stops = false; // there
};

// One step towards the place, up and down and over ground so that it comes to both at the same time.
void fly(body& multirotor, const multirotor_limits& limits, const fly_order& order, double step_s);
// One step of hovering, or of coming to a stop.
void hover(body& multirotor, const multirotor_limits& limits, double step_s);
// One step straight down.
void sink(body& multirotor, const multirotor_limits& limits, double descent_mps, double step_s);
// One step without motors.
void fall(body& multirotor, double step_s);

} // namespace godwit::sim
