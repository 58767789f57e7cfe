#include "programs/godwit-sim/vehicle/flight/mover.hpp"

#include <algorithm>

#include "programs/godwit-sim/vehicle/world/motions.hpp"

namespace godwit::sim {
namespace {

// From this height on it is off the ground.
constexpr double lift_off_m = 0.1;
// The last metres of a landing are slow.
constexpr double slow_below_m = 3;
constexpr double slow_descent_mps = 0.5;
// A fixed wing leaves the ground somewhat faster than it must fly.
constexpr double lift_off_margin = 1.1;

rover_limits wheels(const craft& of) { return {of.acceleration_mps2, of.turn_rate_deg_s}; }
multirotor_limits rotors(const craft& of) { return {of.acceleration_mps2, of.turn_rate_deg_s}; }
fixed_wing_limits wings(const craft& of) { return {of.acceleration_mps2, of.min_speed_mps, of.max_bank_deg}; }

} // namespace

mover::mover(const craft& what, const position& where)
    : craft_(what), ground_m_(where.altitude_m), is_on_rotors_(what.has_rotors) {
  body_.where = where;
}

position mover::return_place(const position& home) const {
  auto result = home;
  for (const auto& each : rally_points_)
    if (between(body_.where, each).distance_m < between(body_.where, result).distance_m)
      result = each;
  return result;
}

void mover::rest(double step_s) {
  circled_.reset();
  spun_up_s_ = 0;
  if (is_rover())
    return brake(body_, wheels(craft_), step_s);
  if (is_in_air_ && is_fixed_wing())
    glide(body_, wings(craft_), step_s);
  else if (is_in_air_)
    fall(body_, step_s);
  else if (is_fixed_wing() && !is_vtol())
    roll(body_, wings(craft_), 0, step_s);
  else
    drop();
  is_on_rotors_ = is_on_rotors_ || (is_vtol() && !is_in_air_);
  meet_ground();
}

void mover::hold(double step_s) {
  is_changing_ = false;
  if (is_rover())
    return brake(body_, wheels(craft_), step_s);
  if (is_in_air_ && is_fixed_wing()) {
    auto centre = circled_.value_or(way(body_.where));
    circle({centre.from(body_.where), centre.to().altitude_m}, 0, own_pace(craft_), step_s);
    circled_ = centre;
    return;
  }
  if (is_in_air_)
    hover(body_, rotors(craft_), step_s);
  else if (is_fixed_wing())
    roll(body_, wings(craft_), 0, step_s);
  else
    drop();
  meet_ground();
}

void mover::go(const heading_for& place, const pace& how_fast, double step_s) {
  is_changing_ = false;
  if (is_blocked_ && !(is_fixed_wing() && is_in_air_))
    return hold(step_s);
  if (is_rover())
    return drive(body_, wheels(craft_), {place.way, how_fast.speed_mps, place.stops}, step_s);
  if (is_fixed_wing() && !is_in_air_)
    return hold(step_s);
  if (is_fixed_wing())
    return fly_wing({place.way.bearing_deg, 0}, place.altitude_m, how_fast, step_s);
  if (!is_in_air_ && spun_up_s_ < craft_.spool_up_s) {
    spun_up_s_ += step_s;
    return hold(step_s);
  }
  const double speed_mps = is_vtol() ? std::min(how_fast.speed_mps, craft_.hover_speed_mps) : how_fast.speed_mps;
  fly(body_, rotors(craft_),
      {place.way, place.altitude_m, speed_mps, how_fast.climb_mps, how_fast.descent_mps, place.stops}, step_s);
  meet_ground();
}

bool mover::change_to(bool wanted_rotors, const pace& how_fast, double step_s) {
  constexpr double far_m = 10'000;
  const double carried_mps = lift_off_margin * craft_.min_speed_mps;
  if (wanted_rotors) {
    was_on_wings_ = !is_on_rotors_ || (is_changing_ && was_on_wings_);
    is_on_rotors_ = true;
    if (is_in_air_)
      hover(body_, rotors(craft_), step_s);
    is_changing_ = body_.ground_speed_mps > craft_.hover_speed_mps;
  } else if (is_on_rotors_ && is_in_air_ && body_.ground_speed_mps < carried_mps) {
    is_changing_ = true;
    was_on_wings_ = false;
    fly(body_, rotors(craft_),
        {{body_.heading_deg, far_m},
         body_.where.altitude_m,
         craft_.speed_mps,
         how_fast.climb_mps,
         how_fast.descent_mps,
         false},
        step_s);
  } else {
    is_on_rotors_ = is_changing_ = false;
  }
  return !is_changing_;
}

std::uint8_t mover::vtol_state() const {
  if (!is_vtol())
    return 0;
  if (is_changing_)
    return was_on_wings_ ? 2 : 1;
  return is_on_rotors_ ? 3 : 4;
}

void mover::fly_wing(const circle_course& where_to, double altitude_m, const pace& how_fast, double step_s) {
  circled_.reset();
  fly(body_, wings(craft_),
      {where_to.course_deg, where_to.turn_rate_rad_s, altitude_m, how_fast.speed_mps, how_fast.climb_mps,
       how_fast.descent_mps},
      step_s);
  meet_ground();
}

void mover::circle(const heading_for& centre, double radius_m, const pace& how_fast, double step_s) {
  if (!is_in_air_)
    return hold(step_s);
  const double own_m = radius_m != 0 ? radius_m : craft_.loiter_radius_m;
  fly_wing(course_on_circle(centre.way, own_m, body_.ground_speed_mps), centre.altitude_m, how_fast, step_s);
}

void mover::climb_ahead(double altitude_m, const pace& how_fast, double step_s) {
  if (is_blocked_ && !is_in_air_)
    return hold(step_s);
  const double lift_off_mps = lift_off_margin * craft_.min_speed_mps;
  if (!is_in_air_ && body_.ground_speed_mps < lift_off_mps)
    return roll(body_, wings(craft_), lift_off_mps, step_s);
  fly_wing({body_.heading_deg, 0}, altitude_m, how_fast, step_s);
}

// The path is led by as much as the altitude lags behind.
void mover::approach(const course& way, double slope, const pace& how_fast, double step_s) {
  const double rest_m = way.distance_m - body_.ground_speed_mps * wing_altitude_lag_s;
  fly_wing({way.bearing_deg, 0}, ground_m_ + slope * rest_m, how_fast, step_s);
}

void mover::land(const pace& how_fast, double step_s) {
  if (is_rover() || !is_in_air_)
    return hold(step_s);
  const double descent_mps = is_low() ? std::min(slow_descent_mps, how_fast.descent_mps) : how_fast.descent_mps;
  if (is_fixed_wing()) // the ground comes before it could level off
    return fly_wing({body_.heading_deg, 0}, ground_m_ - craft_.takeoff_altitude_m,
                    {is_low() ? craft_.min_speed_mps : how_fast.speed_mps, how_fast.climb_mps, descent_mps}, step_s);
  sink(body_, rotors(craft_), descent_mps, step_s);
  meet_ground();
}

void mover::drop() {
  const body before = body_;
  body_ = {};
  body_.where = before.where;
  body_.heading_deg = body_.track_deg = before.heading_deg;
  if (!is_rover())
    body_.where.altitude_m = ground_m_;
  is_in_air_ = false;
  is_changing_ = false;
  circled_.reset();
}

bool mover::is_still() const {
  return body_.ground_speed_mps == 0 && body_.climb_mps == 0 && body_.roll_rad == 0 && body_.pitch_rad == 0 &&
         body_.turn_rate_rad_s == 0;
}

bool mover::is_low() const { return body_.where.altitude_m - ground_m_ < slow_below_m; }

// A fixed wing rolls on after its touch-down.
void mover::meet_ground() {
  const double height_m = body_.where.altitude_m - ground_m_;
  if (is_in_air_ && height_m <= 0) {
    const double speed_mps = body_.ground_speed_mps;
    drop();
    body_.ground_speed_mps = is_fixed_wing() ? speed_mps : 0;
  } else if (height_m > lift_off_m) {
    is_in_air_ = true;
  }
}

} // namespace godwit::sim
