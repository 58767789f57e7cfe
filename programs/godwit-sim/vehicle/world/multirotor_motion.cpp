#include "programs/godwit-sim/vehicle/world/multirotor_motion.hpp"

#include <algorithm>
#include <cmath>

#include "programs/godwit-sim/vehicle/world/angle.hpp"
#include "programs/godwit-sim/vehicle/world/motion_step.hpp"
#include "programs/godwit-sim/vehicle/world/nearby.hpp"

namespace godwit::sim {
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

} // namespace godwit::sim
