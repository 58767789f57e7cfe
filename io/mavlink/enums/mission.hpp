// The numbers in messages about plans. See io/mavlink/enums.hpp.
#pragma once

#include <cstdint>

#include "io/fields/field_table.hpp"

namespace godwit::io::mavlink {

// The answer to a transfer.
enum class mav_mission_result : std::uint8_t {
  accepted = 0,
  error = 1,
  unsupported_frame = 2,
  unsupported = 3,
  no_space = 4,
  invalid = 5,
  invalid_param1 = 6,
  invalid_param2 = 7,
  invalid_param3 = 8,
  invalid_param4 = 9,
  invalid_param5_x = 10,
  invalid_param6_y = 11,
  invalid_param7 = 12,
  invalid_sequence = 13,
  denied = 14,
  operation_cancelled = 15,
};

GODWIT_ENUM_NAMES(mav_mission_result, accepted, error, unsupported_frame, unsupported, no_space, invalid,
                  invalid_param1, invalid_param2, invalid_param3, invalid_param4, invalid_param5_x, invalid_param6_y,
                  invalid_param7, invalid_sequence, denied, operation_cancelled);

// Which of the plans of a vehicle.
enum class mav_mission_type : std::uint8_t {
  mission = 0,
  fence = 1,
  rally = 2,
  all = 255,
};

GODWIT_ENUM_NAMES(mav_mission_type, mission, fence, rally, all);

enum class mission_state : std::uint8_t {
  unknown = 0,
  no_mission = 1,
  not_started = 2,
  active = 3,
  paused = 4,
  complete = 5,
};

GODWIT_ENUM_NAMES(mission_state, unknown, no_mission, not_started, active, paused, complete);

// Numbers that MISSION_CURRENT.mission_mode has, without an enum of their own in MAVLink.
enum class mission_mode : std::uint8_t {
  unknown = 0,
  active = 1,
  suspended = 2,
};

GODWIT_ENUM_NAMES(mission_mode, unknown, active, suspended);

// Of a position. The two with _int are superseded and mean the same as those without.
enum class mav_frame : std::uint8_t {
  global = 0,
  local_ned = 1,
  mission = 2,
  global_relative_alt = 3,
  local_enu = 4,
  global_int = 5,
  global_relative_alt_int = 6,
  local_offset_ned = 7,
  body_ned = 8,
  body_offset_ned = 9,
  global_terrain_alt = 10,
  global_terrain_alt_int = 11,
  body_frd = 12,
  local_frd = 20,
  local_flu = 21,
};

GODWIT_ENUM_NAMES(mav_frame, global, local_ned, mission, global_relative_alt, local_enu, global_int,
                  global_relative_alt_int, local_offset_ned, body_ned, body_offset_ned, global_terrain_alt,
                  global_terrain_alt_int, body_frd, local_frd, local_flu);

} // namespace godwit::io::mavlink
