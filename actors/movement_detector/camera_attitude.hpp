// How the camera lies when the vehicle lies so. Right-handed axes: the vehicle's forward, right, down; the camera's x
// to the right of the picture, y to its lower edge, z into it. Pure. Thread: any. Source: Diebel 2006, angles in the
// order yaw, pitch, roll.
#pragma once

#include <array>
#include <optional>

#include "io/mavlink/messages/gimbal.hpp"

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

// How a gimbal lies on the Earth, from what it says of itself. Pure. Thread: any. Source: MAVLink's gimbal protocol v2,
// GIMBAL_DEVICE_ATTITUDE_STATUS.

// From the gimbal's axes (forward, right, down) to north, east, down. Roll and pitch are always against the horizon;
// yaw is against north, or against the vehicle's heading, which is needed then. Nothing: it is no rotation, both
// frames are claimed, the heading is missing, or the gimbal itself does not trust what it measures.
[[nodiscard]] std::optional<rotation> attitude_of(const io::mavlink::gimbal_device_attitude_status& m,
                                                  std::optional<double> vehicle_heading_rad);

// The mean turn between two attitudes, in the axes of what turns, in rad/s. Gimbals that measure no rate say NaN, and
// those that do differ in whose axes they mean.
[[nodiscard]] std::array<double, 3> rate_between(const rotation& before, const rotation& after, double dt_s);

} // namespace godwit::movement_detector
