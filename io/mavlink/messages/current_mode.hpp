// CURRENT_MODE: the mode that the vehicle is in, and the one that somebody has asked for last. They differ where a
// failsafe of the autopilot has left the mode that was asked for, or where the vehicle can not enter it.
// Source: MAVLink's standard modes (common.xml), whose names and order of fields are kept.
#pragma once

#include <cstdint>

#include "io/mavlink/layout.hpp"

namespace godwit::io::mavlink {

struct current_mode {
  std::uint8_t standard_mode = 0;         // MAV_STANDARD_MODE; 0: none that it could name
  std::uint32_t custom_mode = 0;          // as in HEARTBEAT
  std::uint32_t intended_custom_mode = 0; // 0: not told

  static constexpr std::uint32_t message_id = 436;
  static constexpr std::uint8_t crc_extra = 193;
  GODWIT_FIELDS(current_mode, "CURRENT_MODE", standard_mode, custom_mode, intended_custom_mode);
};

} // namespace godwit::io::mavlink
