#include "actors/movement_detector/gimbal_attitude.hpp"

#include <cmath>

namespace godwit::movement_detector {
namespace {

using io::mavlink::gimbal_device_attitude_status;
namespace device_flags = io::mavlink::gimbal_device_flags;
namespace device_errors = io::mavlink::gimbal_device_error_flags;

constexpr double length_tolerance = 0.01; // floats of a small processor; a quaternion of zeros is far from it
// A limit that is reached or a motor that is weak says nothing against the angles.
constexpr std::uint32_t not_trusted =
    device_errors::encoder_error | device_errors::software_error | device_errors::calibration_running;

// The older rule is for gimbals that name no frame.
std::optional<bool> is_against_north(std::uint16_t flags) {
  const bool earth = (flags & device_flags::yaw_in_earth_frame) != 0;
  const bool vehicle = (flags & device_flags::yaw_in_vehicle_frame) != 0;
  if (earth && vehicle)
    return std::nullopt;
  return earth || (!vehicle && (flags & device_flags::yaw_lock) != 0);
}

} // namespace

std::optional<rotation> attitude_of(const gimbal_device_attitude_status& m, std::optional<double> vehicle_heading_rad) {
  const rotation said{m.q[0], m.q[1], m.q[2], m.q[3]};
  const double length = std::sqrt(said.w * said.w + said.x * said.x + said.y * said.y + said.z * said.z);
  if (!(std::abs(length - 1) <= length_tolerance) || (m.failure_flags & not_trusted) != 0 || // also NaN
      (m.flags & device_flags::retract) != 0)
    return std::nullopt;
  const rotation level{said.w / length, said.x / length, said.y / length, said.z / length};
  const auto against_north = is_against_north(m.flags);
  if (!against_north || (!*against_north && !vehicle_heading_rad))
    return std::nullopt;
  return *against_north ? level : from_angles(0, 0, *vehicle_heading_rad) * level;
}

std::array<double, 3> rate_between(const rotation& before, const rotation& after, double dt_s) {
  rotation turn = inverse(before) * after;
  if (turn.w < 0) // the same turn, the short way round
    turn = {-turn.w, -turn.x, -turn.y, -turn.z};
  const double sine = std::sqrt(turn.x * turn.x + turn.y * turn.y + turn.z * turn.z);
  const double angle = 2 * std::atan2(sine, turn.w);
  const double by = sine < 1e-12 ? 2 / dt_s : angle / (sine * dt_s);
  return {turn.x * by, turn.y * by, turn.z * by};
}

} // namespace godwit::movement_detector
