// How a gimbal lies on the Earth, from what it says of itself. Pure. Thread: any. Source: MAVLink's gimbal protocol v2,
// GIMBAL_DEVICE_ATTITUDE_STATUS.
#pragma once

#include <array>
#include <optional>

#include "actors/movement_detector/camera_attitude.hpp"
#include "io/mavlink/messages/gimbal.hpp"

namespace godwit::movement_detector {

// From the gimbal's axes (forward, right, down) to north, east, down. Roll and pitch are always against the horizon;
// yaw is against north, or against the vehicle's heading, which is needed then. Nothing: it is no rotation, both
// frames are claimed, the heading is missing, or the gimbal itself does not trust what it measures.
[[nodiscard]] std::optional<rotation> attitude_of(const io::mavlink::gimbal_device_attitude_status& m,
                                                  std::optional<double> vehicle_heading_rad);

// The mean turn between two attitudes, in the axes of what turns, in rad/s. Gimbals that measure no rate say NaN, and
// those that do differ in whose axes they mean.
[[nodiscard]] std::array<double, 3> rate_between(const rotation& before, const rotation& after, double dt_s);

} // namespace godwit::movement_detector
