#include "programs/godwit-sim/vehicle/flight/mover.hpp"

#include <algorithm>

#include "programs/godwit-sim/vehicle/world/multirotor_motion.hpp"
#include "programs/godwit-sim/vehicle/world/rover_motion.hpp"

namespace godwit::sim {
namespace {

// From this height on it is off the ground.
constexpr double lift_off_m = 0.1;
// The last metres of a landing are slow.
constexpr double slow_below_m = 3;
constexpr double slow_descent_mps = 0.5;

rover_limits wheels(const craft& of) { return {of.acceleration_mps2, of.turn_rate_deg_s}; }
multirotor_limits rotors(const craft& of) { return {of.acceleration_mps2, of.turn_rate_deg_s}; }

} // namespace

mover::mover(const craft& what, const position& where) : craft_(what), ground_m_(where.altitude_m) {
  body_.where = where;
}

void mover::rest(double step_s) {
  if (!is_multirotor())
    return brake(body_, wheels(craft_), step_s);
  if (is_in_air_)
    fall(body_, step_s);
  else
    drop();
  meet_ground();
}

void mover::hold(double step_s) {
  if (!is_multirotor())
    return brake(body_, wheels(craft_), step_s);
  if (is_in_air_)
    hover(body_, rotors(craft_), step_s);
  else
    drop();
  meet_ground();
}

void mover::go(const heading_for& place, const pace& how_fast, double step_s) {
  if (!is_multirotor())
    return drive(body_, wheels(craft_), {place.way, how_fast.speed_mps, place.stops}, step_s);
  fly(body_, rotors(craft_),
      {place.way, place.altitude_m, how_fast.speed_mps, how_fast.climb_mps, how_fast.descent_mps, place.stops}, step_s);
  meet_ground();
}

void mover::land(const pace& how_fast, double step_s) {
  if (!is_multirotor() || !is_in_air_)
    return hold(step_s);
  const bool is_low = body_.where.altitude_m - ground_m_ < slow_below_m;
  sink(body_, rotors(craft_), is_low ? std::min(slow_descent_mps, how_fast.descent_mps) : how_fast.descent_mps, step_s);
  meet_ground();
}

void mover::drop() {
  const body before = body_;
  body_ = {};
  body_.where = before.where;
  body_.heading_deg = body_.track_deg = before.heading_deg;
  if (is_multirotor())
    body_.where.altitude_m = ground_m_;
  is_in_air_ = false;
}

bool mover::is_still() const {
  return body_.ground_speed_mps == 0 && body_.climb_mps == 0 && body_.roll_rad == 0 && body_.pitch_rad == 0 &&
         body_.turn_rate_rad_s == 0;
}

void mover::meet_ground() {
  const double height_m = body_.where.altitude_m - ground_m_;
  if (is_in_air_ && height_m <= 0)
    drop();
  else if (height_m > lift_off_m)
    is_in_air_ = true;
}

} // namespace godwit::sim
