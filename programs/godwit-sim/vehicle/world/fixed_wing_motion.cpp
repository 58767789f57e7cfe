#include "programs/godwit-sim/vehicle/world/fixed_wing_motion.hpp"

#include <algorithm>
#include <cmath>

#include "programs/godwit-sim/vehicle/world/angle.hpp"
#include "programs/godwit-sim/vehicle/world/motion_step.hpp"
#include "programs/godwit-sim/vehicle/world/nearby.hpp"

namespace godwit::sim {
namespace {

constexpr double wing_vertical_acceleration_mps2 = 3;
constexpr double roll_rate_deg_s = 60;
// An error of its course is turned off in this time, as far as the bank allows.
constexpr double course_lag_s = 1;
constexpr double glide_descent_mps = 2.5;
// How steeply it comes to a circle: at twice the radius its course has turned inwards by the arc tangent of this.
constexpr double circle_gain = 3;
constexpr double cruise_throttle = 0.45;
constexpr double wing_throttle_for_each_mps = 0.1; // of climb

void advance_over_ground(body& it, double wanted_mps, const fixed_wing_limits& limits, double step_s) {
  const double before_mps = it.ground_speed_mps;
  it.ground_speed_mps = towards(before_mps, wanted_mps, limits.acceleration_mps2 * step_s);
  it.track_deg = it.heading_deg;
  const double way_m = (before_mps + it.ground_speed_mps) / 2 * step_s;
  if (way_m != 0)
    it.where = stepped(it.where, way_m * std::cos(it.heading_deg * degree), way_m * std::sin(it.heading_deg * degree));
}

void bank(body& it, double wanted_rad, double step_s) {
  it.roll_rad = towards(it.roll_rad, wanted_rad, roll_rate_deg_s * degree * step_s);
  it.turn_rate_rad_s = it.ground_speed_mps > 0 ? gravity_mps2 * std::tan(it.roll_rad) / it.ground_speed_mps : 0;
  it.heading_deg = heading_of(it.heading_deg + it.turn_rate_rad_s / degree * step_s);
}

void pitch_and_rise(body& it, double wanted_mps, double step_s) {
  climb_towards(it, wanted_mps, wing_vertical_acceleration_mps2, step_s);
  it.pitch_rad = std::atan2(it.climb_mps, std::max(it.ground_speed_mps, 1.0));
}

} // namespace

void fly(body& wing, const fixed_wing_limits& limits, const wing_order& order, double step_s) {
  const double error_rad = turn_of(order.course_deg - wing.heading_deg) * degree;
  const double wanted_rate_rad_s = error_rad / course_lag_s + order.turn_rate_rad_s;
  const double most_rad = limits.max_bank_deg * degree;
  const double wanted_rad = std::atan(wanted_rate_rad_s * wing.ground_speed_mps / gravity_mps2);
  bank(wing, std::clamp(wanted_rad, -most_rad, most_rad), step_s);
  advance_over_ground(wing, std::max(order.speed_mps, limits.min_speed_mps), limits, step_s);
  const double rest_m = order.altitude_m - wing.where.altitude_m;
  pitch_and_rise(wing, std::clamp(rest_m / wing_altitude_lag_s, -order.descent_mps, order.climb_mps), step_s);
  wing.throttle = std::clamp(cruise_throttle + wing_throttle_for_each_mps * wing.climb_mps, 0.0, 1.0);
}

void glide(body& wing, const fixed_wing_limits& limits, double step_s) {
  bank(wing, 0, step_s);
  advance_over_ground(wing, limits.min_speed_mps, limits, step_s);
  pitch_and_rise(wing, -glide_descent_mps, step_s);
  wing.throttle = 0;
}

void roll(body& wing, const fixed_wing_limits& limits, double speed_mps, double step_s) {
  wing.roll_rad = wing.pitch_rad = wing.turn_rate_rad_s = wing.climb_mps = 0;
  advance_over_ground(wing, speed_mps, limits, step_s);
  wing.throttle = speed_mps > 0 ? 1 : 0;
}

circle_course course_on_circle(const course& to_centre, double radius_m, double speed_mps) {
  const double side = radius_m < 0 ? -1 : 1;
  const double size_m = std::abs(radius_m);
  const double off = (to_centre.distance_m - size_m) / size_m;
  const double inwards_deg = std::atan(circle_gain * off) / degree;
  const double from_centre_deg = to_centre.bearing_deg + 180;
  constexpr double near_the_circle = 0.5; // of its radius
  const double rate_rad_s = std::abs(off) < near_the_circle ? side * speed_mps / size_m : 0;
  return {heading_of(from_centre_deg + side * (90 + inwards_deg)), rate_rad_s};
}

} // namespace godwit::sim
