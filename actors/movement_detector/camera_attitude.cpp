#include "actors/movement_detector/camera_attitude.hpp"

#include <cmath>

namespace godwit::movement_detector {

rotation from_angles(double roll_rad, double pitch_rad, double yaw_rad) {
  const double cr = std::cos(roll_rad / 2);
  const double sr = std::sin(roll_rad / 2);
  const double cp = std::cos(pitch_rad / 2);
  const double sp = std::sin(pitch_rad / 2);
  const double cy = std::cos(yaw_rad / 2);
  const double sy = std::sin(yaw_rad / 2);
  return {cr * cp * cy + sr * sp * sy, sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy,
          cr * cp * sy - sr * sp * cy};
}

rotation operator*(const rotation& a, const rotation& b) {
  return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
          a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

rotation inverse(const rotation& of) { return {of.w, -of.x, -of.y, -of.z}; }

std::array<double, 3> turned(const rotation& by, const std::array<double, 3>& what) {
  const auto result = by * rotation{0, what[0], what[1], what[2]} * inverse(by);
  return {result.x, result.y, result.z};
}

rotation mount_of(double roll_rad, double pitch_rad, double yaw_rad) {
  // x to the right, y to down, z to ahead: a camera that looks ahead.
  constexpr rotation ahead{0.5, 0.5, 0.5, 0.5};
  return from_angles(roll_rad, pitch_rad, yaw_rad) * ahead;
}

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
