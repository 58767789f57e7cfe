#include "programs/godwit-sim/vehicle/world/rover_motion.hpp"

#include <algorithm>
#include <cmath>

#include "programs/godwit-sim/vehicle/world/angle.hpp"
#include "programs/godwit-sim/vehicle/world/motion_step.hpp"
#include "programs/godwit-sim/vehicle/world/nearby.hpp"

namespace godwit::sim {
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
