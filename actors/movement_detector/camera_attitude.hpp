// How the camera lies when the vehicle lies so. Right-handed axes: the vehicle's forward, right, down; the camera's x
// to the right of the picture, y to its lower edge, z into it. Pure. Thread: any. Source: Diebel 2006, angles in the
// order yaw, pitch, roll.
#pragma once

#include <array>

namespace godwit::movement_detector {

struct rotation {
  double w = 1;
  double x = 0;
  double y = 0;
  double z = 0;
};

[[nodiscard]] rotation from_angles(double roll_rad, double pitch_rad, double yaw_rad);
// First B, then A.
[[nodiscard]] rotation operator*(const rotation& a, const rotation& b);
[[nodiscard]] rotation inverse(const rotation& of);
[[nodiscard]] std::array<double, 3> turned(const rotation& by, const std::array<double, 3>& what);

// From camera axes to the vehicle's, for a mount with these angles; 0, 0, 0 looks ahead, pitch -90 degrees straight
// down.
[[nodiscard]] rotation mount_of(double roll_rad, double pitch_rad, double yaw_rad);

} // namespace godwit::movement_detector
