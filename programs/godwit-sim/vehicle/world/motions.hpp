// How the kinds of vehicle move in a step of time. Thread: pure.
#pragma once

#include "programs/godwit-sim/vehicle/world/body.hpp"

namespace godwit::sim {

// How a fixed wing flies: it never stands in the air, turns by banking, at most so far, climbs and sinks at most so
// fast. There is no wind, so that its air speed is its ground speed. Ground and the plan of a flight are not its
// business, but for rolling along a runway. Thread: pure. Source: the coordinated turn (rate = g tan(bank) / speed).
struct fixed_wing_limits {
  double acceleration_mps2 = 3; // along its track
  double min_speed_mps = 10;    // below it no wing carries
  double max_bank_deg = 45;
};

struct wing_order {
  double course_deg = 0;
  double turn_rate_rad_s = 0; // at which the course turns by itself: on a circle; to the right
  double altitude_m = 0;
  double speed_mps = 0;
  double climb_mps = 0;
  double descent_mps = 0;
};

// How fast it comes to an altitude: what is left of the difference after this time is a third.
constexpr double wing_altitude_lag_s = 2;

// One step in the air, towards the course and the altitude.
void fly(body& wing, const fixed_wing_limits& limits, const wing_order& order, double step_s);
// One step without a motor: straight on and down.
void glide(body& wing, const fixed_wing_limits& limits, double step_s);
// One step on the ground, straight on, to this speed; 0: to a stop.
void roll(body& wing, const fixed_wing_limits& limits, double speed_mps, double step_s);

// A circle around the place at the end of the way TO_CENTRE. RADIUS_M: negative: to the left.
struct circle_course {
  double course_deg = 0;
  double turn_rate_rad_s = 0; // 0 far away from the circle
};
[[nodiscard]] circle_course course_on_circle(const course& to_centre, double radius_m, double speed_mps);

// How a multirotor flies: it accelerates at most so hard, climbs and descends at most so fast, leans into what it does
// and turns its nose to where it flies. Ground and the beginning and end of a flight are not its business. Thread:
// pure.
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

// How a rover drives: it turns at most so fast, speeds up and brakes at most so hard, and goes where it points to.
// Thread: pure.
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
