// Other aircraft, as an ADS-B receiver or the autopilot reports them: ADSB_VEHICLE, COLLISION.
// Source: MAVLink's common.xml, whose names and order of fields are kept.
#pragma once

#include <array>
#include <cstdint>

#include "io/mavlink/layout.hpp"

namespace godwit::io::mavlink {

// Bits of ADSB_VEHICLE.flags: what is not marked valid says nothing, whatever its field holds.
enum class adsb_flag : std::uint16_t {
  valid_coords = 1,
  valid_altitude = 2,
  valid_heading = 4,
  valid_velocity = 8,
  valid_callsign = 16,
  vertical_velocity_valid = 128,
};

inline constexpr std::uint8_t altitude_pressure_qnh = 0; // ADSB_VEHICLE.altitude_type; 1: by a satellite receiver

struct adsb_vehicle {
  std::uint32_t icao_address = 0;
  std::int32_t lat = 0; // degrees times 1e7
  std::int32_t lon = 0;
  std::uint8_t altitude_type = 0;
  std::int32_t altitude = 0;         // mm above mean sea level
  std::uint16_t heading = 0;         // 0.01 degrees, course over ground
  std::uint16_t hor_velocity = 0;    // cm/s
  std::int16_t ver_velocity = 0;     // cm/s up
  std::array<char, 9> callsign = {}; // eight characters and their end
  std::uint8_t emitter_type = 0;
  std::uint8_t tslc = 0; // s since it was heard last
  std::uint16_t flags = 0;
  std::uint16_t squawk = 0;

  static constexpr std::uint32_t message_id = 246;
  static constexpr std::uint8_t crc_extra = 184;
  static constexpr auto fields = io::table(
      "ADSB_VEHICLE", io::field("ICAO_address", &adsb_vehicle::icao_address), io::field("lat", &adsb_vehicle::lat),
      io::field("lon", &adsb_vehicle::lon), io::field("altitude_type", &adsb_vehicle::altitude_type),
      io::field("altitude", &adsb_vehicle::altitude), io::field("heading", &adsb_vehicle::heading),
      io::field("hor_velocity", &adsb_vehicle::hor_velocity), io::field("ver_velocity", &adsb_vehicle::ver_velocity),
      io::field("callsign", &adsb_vehicle::callsign), io::field("emitter_type", &adsb_vehicle::emitter_type),
      io::field("tslc", &adsb_vehicle::tslc), io::field("flags", &adsb_vehicle::flags),
      io::field("squawk", &adsb_vehicle::squawk));
};

inline constexpr std::uint8_t collision_source_adsb = 0; // COLLISION.src: then `id` is an ICAO address

// The autopilot's own warning, and what it does about it.
struct collision {
  std::uint8_t src = 0;
  std::uint32_t id = 0;
  std::uint8_t action = 0;            // MAV_COLLISION_ACTION
  std::uint8_t threat_level = 0;      // 0 none, 1 low, 2 high
  float time_to_minimum_delta = 0;    // s
  float altitude_minimum_delta = 0;   // m
  float horizontal_minimum_delta = 0; // m

  static constexpr std::uint32_t message_id = 247;
  static constexpr std::uint8_t crc_extra = 81;
  GODWIT_FIELDS(collision, "COLLISION", src, id, action, threat_level, time_to_minimum_delta, altitude_minimum_delta,
                horizontal_minimum_delta);
};

} // namespace godwit::io::mavlink
