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
  static constexpr auto fields =
      table("GPS_RAW_INT", field("time_usec", &gps_raw_int::time_usec), field("fix_type", &gps_raw_int::fix_type),
            field("lat", &gps_raw_int::lat), field("lon", &gps_raw_int::lon), field("alt", &gps_raw_int::alt),
            field("eph", &gps_raw_int::eph), field("epv", &gps_raw_int::epv), field("vel", &gps_raw_int::vel),
            field("cog", &gps_raw_int::cog), field("satellites_visible", &gps_raw_int::satellites_visible),
            field("alt_ellipsoid", &gps_raw_int::alt_ellipsoid), field("h_acc", &gps_raw_int::h_acc),
            field("v_acc", &gps_raw_int::v_acc), field("vel_acc", &gps_raw_int::vel_acc),
            field("hdg_acc", &gps_raw_int::hdg_acc), field("yaw", &gps_raw_int::yaw));
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
  static constexpr auto fields =
      table("ATTITUDE", field("time_boot_ms", &attitude::time_boot_ms), field("roll", &attitude::roll),
            field("pitch", &attitude::pitch), field("yaw", &attitude::yaw), field("rollspeed", &attitude::rollspeed),
            field("pitchspeed", &attitude::pitchspeed), field("yawspeed", &attitude::yawspeed));
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
  static constexpr auto fields =
      table("GLOBAL_POSITION_INT", field("time_boot_ms", &global_position_int::time_boot_ms),
            field("lat", &global_position_int::lat), field("lon", &global_position_int::lon),
            field("alt", &global_position_int::alt), field("relative_alt", &global_position_int::relative_alt),
            field("vx", &global_position_int::vx), field("vy", &global_position_int::vy),
            field("vz", &global_position_int::vz), field("hdg", &global_position_int::hdg));
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
  static constexpr auto fields =
      table("VFR_HUD", field("airspeed", &vfr_hud::airspeed), field("groundspeed", &vfr_hud::groundspeed),
            field("heading", &vfr_hud::heading), field("throttle", &vfr_hud::throttle), field("alt", &vfr_hud::alt),
            field("climb", &vfr_hud::climb));
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
  static constexpr auto fields =
      table("HOME_POSITION", field("latitude", &home_position::latitude), field("longitude", &home_position::longitude),
            field("altitude", &home_position::altitude), field("x", &home_position::x), field("y", &home_position::y),
            field("z", &home_position::z), field("q", &home_position::q),
            field("approach_x", &home_position::approach_x), field("approach_y", &home_position::approach_y),
            field("approach_z", &home_position::approach_z), field("time_usec", &home_position::time_usec));
};

} // namespace godwit::io::mavlink
