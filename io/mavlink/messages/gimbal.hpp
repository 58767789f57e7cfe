// How a gimbal lies: GIMBAL_DEVICE_ATTITUDE_STATUS. Sent by the gimbal itself, or by the autopilot for it.
// Source: MAVLink's common.xml, whose names and order of fields are kept; gimbal protocol v2.
#pragma once

#include <array>
#include <cstdint>

#include "io/mavlink/layout.hpp"

namespace godwit::io::mavlink {

namespace gimbal_device_flags {
inline constexpr std::uint16_t retract = 1;
inline constexpr std::uint16_t yaw_lock = 16;
inline constexpr std::uint16_t yaw_in_vehicle_frame = 32;
inline constexpr std::uint16_t yaw_in_earth_frame = 64;
} // namespace gimbal_device_flags

namespace gimbal_device_error_flags {
inline constexpr std::uint32_t encoder_error = 8;
inline constexpr std::uint32_t software_error = 128;
inline constexpr std::uint32_t calibration_running = 512;
} // namespace gimbal_device_error_flags

// Angles in rad, rates in rad/s.
struct gimbal_device_attitude_status {
  std::uint8_t target_system = 0;
  std::uint8_t target_component = 0;
  std::uint32_t time_boot_ms = 0; // of who sends it
  std::uint16_t flags = 0;        // gimbal_device_flags
  // w, x, y, z; turns the gimbal's axes (forward, right, down) into level ones: x to north, or along the vehicle's
  // heading, as the flags say.
  std::array<float, 4> q{};
  float angular_velocity_x = 0; // NaN: unknown
  float angular_velocity_y = 0;
  float angular_velocity_z = 0;
  std::uint32_t failure_flags = 0; // gimbal_device_error_flags
  float delta_yaw = 0;             // from the vehicle's heading to north; NaN: unknown
  float delta_yaw_velocity = 0;
  std::uint8_t gimbal_device_id = 0; // 1 to 6: of a gimbal that has no component id; 0: it has one

  static constexpr std::uint32_t message_id = 285;
  static constexpr std::uint8_t crc_extra = 137;
  static constexpr std::size_t extensions = 3;
  GODWIT_FIELDS(gimbal_device_attitude_status, "GIMBAL_DEVICE_ATTITUDE_STATUS", target_system, target_component,
                time_boot_ms, flags, q, angular_velocity_x, angular_velocity_y, angular_velocity_z, failure_flags,
                delta_yaw, delta_yaw_velocity, gimbal_device_id);
};

} // namespace godwit::io::mavlink
