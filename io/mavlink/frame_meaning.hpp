// What the numbers of a position mean in each MAV_FRAME: x and y of MISSION_ITEM_INT and COMMAND_INT, and the altitude.
//
//   coordinates   frames                            x and y
//   global        0, 3, 5, 6, 10, 11                degrees times 1e7
//   local         1, 4, 7, 8, 9, 12, 20, 21         metres times 1e4
//   none          2 (mission: no position)          whole numbers
//
// None for a frame that MAVLink does not define, or has withdrawn. Thread: pure. Source: MAVLink's common.xml,
// MAV_FRAME.
#pragma once

#include <cstdint>
#include <optional>

#include "io/mavlink/enums/mission.hpp"

namespace godwit::io::mavlink {

enum class coordinate_kind { global, local, none };

[[nodiscard]] constexpr std::optional<coordinate_kind> coordinates_of(std::uint8_t frame) {
  switch (static_cast<mav_frame>(frame)) {
  case mav_frame::global:
  case mav_frame::global_relative_alt:
  case mav_frame::global_int:
  case mav_frame::global_relative_alt_int:
  case mav_frame::global_terrain_alt:
  case mav_frame::global_terrain_alt_int:
    return coordinate_kind::global;
  case mav_frame::local_ned:
  case mav_frame::local_enu:
  case mav_frame::local_offset_ned:
  case mav_frame::body_ned:
  case mav_frame::body_offset_ned:
  case mav_frame::body_frd:
  case mav_frame::local_frd:
  case mav_frame::local_flu:
    return coordinate_kind::local;
  case mav_frame::mission:
    return coordinate_kind::none;
  }
  return std::nullopt;
}

// How many of x or y make one degree or metre.
[[nodiscard]] constexpr std::int32_t units_of(coordinate_kind kind) {
  switch (kind) {
  case coordinate_kind::global:
    return 10'000'000;
  case coordinate_kind::local:
    return 10'000;
  case coordinate_kind::none:
    break;
  }
  return 1;
}

// Divided by, so that a coordinate keeps its digits.
inline constexpr double units_a_degree = units_of(coordinate_kind::global);

enum class altitude_kind { above_sea, above_home, above_terrain };

// None: local frames, and frames without a position.
[[nodiscard]] constexpr std::optional<altitude_kind> altitude_in(std::uint8_t frame) {
  switch (static_cast<mav_frame>(frame)) {
  case mav_frame::global:
  case mav_frame::global_int:
    return altitude_kind::above_sea;
  case mav_frame::global_relative_alt:
  case mav_frame::global_relative_alt_int:
    return altitude_kind::above_home;
  case mav_frame::global_terrain_alt:
  case mav_frame::global_terrain_alt_int:
    return altitude_kind::above_terrain;
  default:
    return std::nullopt;
  }
}

} // namespace godwit::io::mavlink
