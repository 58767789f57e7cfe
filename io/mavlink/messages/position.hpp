// Where the vehicle is and how it moves: GPS_RAW_INT, ATTITUDE, GLOBAL_POSITION_INT, VFR_HUD, HOME_POSITION.
// Latitudes and longitudes are degrees times 1e7, altitudes mm where they are integers and m where they are floats.
// Source: MAVLink's common.xml, whose names and order of fields are kept.
#pragma once

#include <array>
#include <cstdint>

#include "io/mavlink/layout.hpp"

namespace godwit::io::mavlink {

struct gps_raw_int {
  std::uint64_t time_usec = 0;
  std::uint8_t fix_type = 0; // gps_fix_type
  std::int32_t lat = 0;
  std::int32_t lon = 0;
  std::int32_t alt = 0;                // mm above mean sea level
  std::uint16_t eph = 0;               // HDOP times 100, 65535 unknown
  std::uint16_t epv = 0;               // VDOP times 100, 65535 unknown
  std::uint16_t vel = 0;               // cm/s, 65535 unknown
  std::uint16_t cog = 0;               // 0.01 degrees, 65535 unknown
  std::uint8_t satellites_visible = 0; // 255 unknown
  std::int32_t alt_ellipsoid = 0;      // mm
  std::uint32_t h_acc = 0;             // mm
  std::uint32_t v_acc = 0;             // mm
  std::uint32_t vel_acc = 0;           // mm/s
  std::uint32_t hdg_acc = 0;           // 1e-5 degrees
  std::uint16_t yaw = 0;               // 0.01 degrees, 0 unknown

  static constexpr std::uint32_t message_id = 24;
  static constexpr std::uint8_t crc_extra = 24;
  static constexpr std::size_t extensions = 6;
  GODWIT_FIELDS(gps_raw_int, "GPS_RAW_INT", time_usec, fix_type, lat, lon, alt, eph, epv, vel, cog, satellites_visible,
                alt_ellipsoid, h_acc, v_acc, vel_acc, hdg_acc, yaw);
};

// Angles in rad, rates in rad/s.
struct attitude {
  std::uint32_t time_boot_ms = 0;
  float roll = 0;
  float pitch = 0;
  float yaw = 0;
  float rollspeed = 0;
  float pitchspeed = 0;
  float yawspeed = 0;

  static constexpr std::uint32_t message_id = 30;
  static constexpr std::uint8_t crc_extra = 39;
  GODWIT_FIELDS(attitude, "ATTITUDE", time_boot_ms, roll, pitch, yaw, rollspeed, pitchspeed, yawspeed);
};

struct global_position_int {
  std::uint32_t time_boot_ms = 0;
  std::int32_t lat = 0;
  std::int32_t lon = 0;
  std::int32_t alt = 0;          // mm above mean sea level
  std::int32_t relative_alt = 0; // mm above home
  std::int16_t vx = 0;           // cm/s north
  std::int16_t vy = 0;           // cm/s east
  std::int16_t vz = 0;           // cm/s down
  std::uint16_t hdg = 0;         // 0.01 degrees, 65535 unknown

  static constexpr std::uint32_t message_id = 33;
  static constexpr std::uint8_t crc_extra = 104;
  GODWIT_FIELDS(global_position_int, "GLOBAL_POSITION_INT", time_boot_ms, lat, lon, alt, relative_alt, vx, vy, vz, hdg);
};

// Speeds in m/s.
struct vfr_hud {
  float airspeed = 0;
  float groundspeed = 0;
  std::int16_t heading = 0;   // degrees
  std::uint16_t throttle = 0; // %
  float alt = 0;              // m above mean sea level
  float climb = 0;

  static constexpr std::uint32_t message_id = 74;
  static constexpr std::uint8_t crc_extra = 20;
  GODWIT_FIELDS(vfr_hud, "VFR_HUD", airspeed, groundspeed, heading, throttle, alt, climb);
};

struct home_position {
  std::int32_t latitude = 0;
  std::int32_t longitude = 0;
  std::int32_t altitude = 0; // mm above mean sea level
  float x = 0;
  float y = 0;
  float z = 0;
  std::array<float, 4> q{};
  float approach_x = 0;
  float approach_y = 0;
  float approach_z = 0;
  std::uint64_t time_usec = 0;

  static constexpr std::uint32_t message_id = 242;
  static constexpr std::uint8_t crc_extra = 104;
  static constexpr std::size_t extensions = 1;
  GODWIT_FIELDS(home_position, "HOME_POSITION", latitude, longitude, altitude, x, y, z, q, approach_x, approach_y,
                approach_z, time_usec);
};

} // namespace godwit::io::mavlink
