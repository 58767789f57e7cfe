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

} // namespace godwit::movement_detector
