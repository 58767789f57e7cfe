#include "programs/godwit-sim/vehicle/world/motions.hpp"

#include <algorithm>
#include <cmath>

#include "programs/godwit-sim/vehicle/world/angle.hpp"
#include "programs/godwit-sim/vehicle/world/body.hpp"
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

namespace {

constexpr double vertical_acceleration_mps2 = 2;
// Who is as near as this is there.
constexpr double there_m = 0.05;
constexpr double at_altitude_m = 0.01;
// The nose stays where it is for ways that are shorter.
constexpr double turn_beyond_m = 3;
// The body follows the wanted tilt with this lag, and is level below the last of the angles that matter.
constexpr double tilt_lag_s = 0.15;
constexpr double level_rad = 1e-4;
constexpr double hover_throttle = 0.4;
constexpr double throttle_for_each_mps = 0.08; // of climb

struct over_ground {
  double north = 0;
  double east = 0;
};

over_ground along(double bearing_deg, double length) {
  return {length * std::cos(bearing_deg * degree), length * std::sin(bearing_deg * degree)};
}

void lean(body& it, const over_ground& acceleration, double step_s) {
  const auto nose = along(it.heading_deg, 1);
  const double forward = acceleration.north * nose.north + acceleration.east * nose.east;
  const double right = acceleration.east * nose.north - acceleration.north * nose.east;
  const double share = std::min(1.0, step_s / tilt_lag_s);
  it.pitch_rad += (std::atan2(-forward, gravity_mps2) - it.pitch_rad) * share;
  it.roll_rad += (std::atan2(right, gravity_mps2) - it.roll_rad) * share;
  if (std::abs(it.pitch_rad) < level_rad && std::abs(it.roll_rad) < level_rad)
    it.pitch_rad = it.roll_rad = 0;
}

// Brings the motion over ground towards WANTED and moves.
void glide(body& it, const over_ground& wanted, const multirotor_limits& limits, double step_s) {
  if (it.ground_speed_mps == 0 && wanted.north == 0 && wanted.east == 0) {
    if (it.pitch_rad != 0 || it.roll_rad != 0)
      lean(it, {}, step_s);
    return;
  }
  const auto before = along(it.track_deg, it.ground_speed_mps);
  over_ground change{wanted.north - before.north, wanted.east - before.east};
  const double size = std::hypot(change.north, change.east);
  const double most = limits.acceleration_mps2 * step_s;
  auto after = wanted; // exactly, so that who stops stands
  if (size > most) {
    change = {change.north * most / size, change.east * most / size};
    after = {before.north + change.north, before.east + change.east};
  }
  lean(it, {change.north / step_s, change.east / step_s}, step_s);
  it.where = stepped(it.where, (before.north + after.north) / 2 * step_s, (before.east + after.east) / 2 * step_s);
  it.ground_speed_mps = std::hypot(after.north, after.east);
  if (it.ground_speed_mps > 0)
    it.track_deg = heading_of(std::atan2(after.east, after.north) / degree);
}

void rise(body& it, double wanted_mps, double step_s) {
  climb_towards(it, wanted_mps, vertical_acceleration_mps2, step_s);
  it.throttle = std::clamp(hover_throttle + throttle_for_each_mps * it.climb_mps, 0.0, 1.0);
}

void rise_to(body& it, const fly_order& order, double step_s) {
  const double rest_m = order.altitude_m - it.where.altitude_m;
  if (std::abs(rest_m) < at_altitude_m && std::abs(it.climb_mps) <= vertical_acceleration_mps2 * step_s) {
    it.where.altitude_m = order.altitude_m;
    it.climb_mps = 0;
    it.throttle = hover_throttle;
    return;
  }
  const double braking_mps = std::sqrt(2 * braking_margin * vertical_acceleration_mps2 * std::abs(rest_m));
  const double wanted_mps = std::min(rest_m > 0 ? order.climb_mps : order.descent_mps, braking_mps);
  rise(it, std::copysign(wanted_mps, rest_m), step_s);
}

double fit_speed(const body& it, const multirotor_limits& limits, const fly_order& order) {
  const double distance_m = order.way.distance_m;
  if (distance_m < there_m)
    return 0;
  const double rest_m = order.altitude_m - it.where.altitude_m;
  const double vertical_s = std::abs(rest_m) / (rest_m > 0 ? order.climb_mps : order.descent_mps);
  double speed_mps = order.speed_mps;
  if (speed_mps * vertical_s > distance_m)
    speed_mps = distance_m / vertical_s;
  if (order.stops)
    speed_mps = std::min(speed_mps, std::sqrt(2 * braking_margin * limits.acceleration_mps2 * distance_m));
  return speed_mps;
}

void turn_nose(body& it, const multirotor_limits& limits, double bearing_deg, double step_s) {
  const double most_deg = limits.turn_rate_deg_s * step_s;
  const double turn_deg = std::clamp(turn_of(bearing_deg - it.heading_deg), -most_deg, most_deg);
  it.heading_deg = heading_of(it.heading_deg + turn_deg);
  it.turn_rate_rad_s = turn_deg * degree / step_s;
}

} // namespace

void fly(body& multirotor, const multirotor_limits& limits, const fly_order& order, double step_s) {
  const double speed_mps = fit_speed(multirotor, limits, order);
  if (order.way.distance_m > turn_beyond_m)
    turn_nose(multirotor, limits, order.way.bearing_deg, step_s);
  else
    multirotor.turn_rate_rad_s = 0;
  glide(multirotor, along(order.way.bearing_deg, speed_mps), limits, step_s);
  rise_to(multirotor, order, step_s);
}

void hover(body& multirotor, const multirotor_limits& limits, double step_s) { sink(multirotor, limits, 0, step_s); }

void sink(body& multirotor, const multirotor_limits& limits, double descent_mps, double step_s) {
  multirotor.turn_rate_rad_s = 0;
  glide(multirotor, {}, limits, step_s);
  rise(multirotor, -descent_mps, step_s);
}

void fall(body& multirotor, double step_s) {
  const double before_mps = multirotor.climb_mps;
  multirotor.climb_mps -= gravity_mps2 * step_s;
  multirotor.where.altitude_m += (before_mps + multirotor.climb_mps) / 2 * step_s;
  multirotor.turn_rate_rad_s = 0;
  multirotor.throttle = 0;
}

namespace {

// Of the speed whose circle just meets the place: turning begins late where the rover has to brake first.
constexpr double turning_margin = 0.6;
// Who is to stop there is there.
constexpr double stop_within_m = 0.1;
// At which the motor has nothing left.
constexpr double full_throttle_mps = 10;

double fit_speed(const rover_limits& limits, const drive_order& order, double error_deg) {
  double speed_mps = order.speed_mps;
  const double distance_m = order.way.distance_m;
  if (order.stops) {
    const double room_m = std::max(0.0, distance_m - stop_within_m);
    speed_mps = std::min(speed_mps, std::sqrt(2 * braking_margin * limits.acceleration_mps2 * room_m));
  }
  // The circle that begins along the heading and goes through the place has the radius distance / (2 sin(error)).
  const double sine = std::abs(error_deg) < 90 ? std::sin(std::abs(error_deg) * degree) : 1;
  const double turning_mps = turning_margin * limits.turn_rate_deg_s * degree * distance_m / 2;
  return speed_mps * sine > turning_mps ? turning_mps / sine : speed_mps;
}

void roll_on(body& rover, double wanted_mps, const rover_limits& limits, double step_s) {
  const double before_mps = rover.ground_speed_mps;
  rover.ground_speed_mps = towards(before_mps, wanted_mps, limits.acceleration_mps2 * step_s);
  rover.track_deg = rover.heading_deg;
  rover.throttle = std::min(1.0, rover.ground_speed_mps / full_throttle_mps);
  const double way_m = (before_mps + rover.ground_speed_mps) / 2 * step_s;
  if (way_m == 0)
    return;
  const double heading_rad = rover.heading_deg * degree;
  rover.where = stepped(rover.where, way_m * std::cos(heading_rad), way_m * std::sin(heading_rad));
}

} // namespace

void drive(body& rover, const rover_limits& limits, const drive_order& order, double step_s) {
  const double error_deg = turn_of(order.way.bearing_deg - rover.heading_deg);
  const double most_deg = limits.turn_rate_deg_s * step_s;
  const double turn_deg = std::clamp(error_deg, -most_deg, most_deg);
  rover.heading_deg = heading_of(rover.heading_deg + turn_deg);
  rover.turn_rate_rad_s = turn_deg * degree / step_s;
  roll_on(rover, fit_speed(limits, order, error_deg - turn_deg), limits, step_s);
}

void brake(body& rover, const rover_limits& limits, double step_s) {
  rover.turn_rate_rad_s = 0;
  roll_on(rover, 0, limits, step_s);
}

} // namespace godwit::sim
