// That a picture was taken: CAMERA_FEEDBACK of an ArduPilot, CAMERA_IMAGE_CAPTURED of a PX4 or a camera.
// Source: MAVLink's ardupilotmega.xml and common.xml, whose names and order of fields are kept.
#pragma once

#include <array>
#include <cstdint>

#include "io/mavlink/layout.hpp"

namespace godwit::io::mavlink {

// Places in degrees * 1e7, altitudes in m, angles in degrees.
struct camera_feedback {
  std::uint64_t time_usec = 0; // since 1970
  std::uint8_t target_system = 0;
  std::uint8_t cam_idx = 0;
  std::uint16_t img_idx = 0; // of the pictures since the autopilot started, from 1 on
  std::int32_t lat = 0;
  std::int32_t lng = 0;
  float alt_msl = 0;
  float alt_rel = 0;
  float roll = 0;
  float pitch = 0;
  float yaw = 0;
  float foc_len = 0;
  std::uint8_t flags = 0;
  std::uint16_t completed_captures = 0;

  static constexpr std::uint32_t message_id = 180;
  static constexpr std::uint8_t crc_extra = 52;
  static constexpr std::size_t extensions = 1;
  GODWIT_FIELDS(camera_feedback, "CAMERA_FEEDBACK", time_usec, target_system, cam_idx, img_idx, lat, lng, alt_msl,
                alt_rel, roll, pitch, yaw, foc_len, flags, completed_captures);
};

// Places in degrees * 1e7, altitudes in mm.
struct camera_image_captured {
  std::uint32_t time_boot_ms = 0;
  std::uint64_t time_utc = 0; // us since 1970
  std::uint8_t camera_id = 0;
  std::int32_t lat = 0;
  std::int32_t lon = 0;
  std::int32_t alt = 0;
  std::int32_t relative_alt = 0;
  std::array<float, 4> q{};
  std::int32_t image_index = 0;   // from 0 on
  std::int8_t capture_result = 0; // 1: taken, 0: failed
  std::array<char, 205> file_url{};

  static constexpr std::uint32_t message_id = 263;
  static constexpr std::uint8_t crc_extra = 133;
  GODWIT_FIELDS(camera_image_captured, "CAMERA_IMAGE_CAPTURED", time_boot_ms, time_utc, camera_id, lat, lon, alt,
                relative_alt, q, image_index, capture_result, file_url);
};

} // namespace godwit::io::mavlink
