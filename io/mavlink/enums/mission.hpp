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

constexpr auto enum_names(mav_mission_result) {
  return names<mav_mission_result>({{mav_mission_result::accepted, "accepted"},
                                    {mav_mission_result::error, "error"},
                                    {mav_mission_result::unsupported_frame, "unsupported_frame"},
                                    {mav_mission_result::unsupported, "unsupported"},
                                    {mav_mission_result::no_space, "no_space"},
                                    {mav_mission_result::invalid, "invalid"},
                                    {mav_mission_result::invalid_param1, "invalid_param1"},
                                    {mav_mission_result::invalid_param2, "invalid_param2"},
                                    {mav_mission_result::invalid_param3, "invalid_param3"},
                                    {mav_mission_result::invalid_param4, "invalid_param4"},
                                    {mav_mission_result::invalid_param5_x, "invalid_param5_x"},
                                    {mav_mission_result::invalid_param6_y, "invalid_param6_y"},
                                    {mav_mission_result::invalid_param7, "invalid_param7"},
                                    {mav_mission_result::invalid_sequence, "invalid_sequence"},
                                    {mav_mission_result::denied, "denied"},
                                    {mav_mission_result::operation_cancelled, "operation_cancelled"}});
}

// Which of the plans of a vehicle.
enum class mav_mission_type : std::uint8_t {
  mission = 0,
  fence = 1,
  rally = 2,
  all = 255,
};

constexpr auto enum_names(mav_mission_type) {
  return names<mav_mission_type>({{mav_mission_type::mission, "mission"},
                                  {mav_mission_type::fence, "fence"},
                                  {mav_mission_type::rally, "rally"},
                                  {mav_mission_type::all, "all"}});
}

enum class mission_state : std::uint8_t {
  unknown = 0,
  no_mission = 1,
  not_started = 2,
  active = 3,
  paused = 4,
  complete = 5,
};

constexpr auto enum_names(mission_state) {
  return names<mission_state>({{mission_state::unknown, "unknown"},
                               {mission_state::no_mission, "no_mission"},
                               {mission_state::not_started, "not_started"},
                               {mission_state::active, "active"},
                               {mission_state::paused, "paused"},
                               {mission_state::complete, "complete"}});
}

// Numbers that MISSION_CURRENT.mission_mode has, without an enum of their own in MAVLink.
enum class mission_mode : std::uint8_t {
  unknown = 0,
  active = 1,
  suspended = 2,
};

constexpr auto enum_names(mission_mode) {
  return names<mission_mode>(
      {{mission_mode::unknown, "unknown"}, {mission_mode::active, "active"}, {mission_mode::suspended, "suspended"}});
}

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

constexpr auto enum_names(mav_frame) {
  return names<mav_frame>({{mav_frame::global, "global"},
                           {mav_frame::local_ned, "local_ned"},
                           {mav_frame::mission, "mission"},
                           {mav_frame::global_relative_alt, "global_relative_alt"},
                           {mav_frame::local_enu, "local_enu"},
                           {mav_frame::global_int, "global_int"},
                           {mav_frame::global_relative_alt_int, "global_relative_alt_int"},
                           {mav_frame::local_offset_ned, "local_offset_ned"},
                           {mav_frame::body_ned, "body_ned"},
                           {mav_frame::body_offset_ned, "body_offset_ned"},
                           {mav_frame::global_terrain_alt, "global_terrain_alt"},
                           {mav_frame::global_terrain_alt_int, "global_terrain_alt_int"},
                           {mav_frame::body_frd, "body_frd"},
                           {mav_frame::local_frd, "local_frd"},
                           {mav_frame::local_flu, "local_flu"}});
}

} // namespace godwit::io::mavlink
