// "QGC WPL 100", from before MAVLink 1.0: thirteen columns in another order, and actions of its own.
//
//   INDEX FRAME ACTION ORBIT DIRECTION PARAM1 PARAM2 CURRENT LONGITUDE LATITUDE ALTITUDE YAW AUTOCONTINUE
//
// Thread: constants, pure. Source: pymavlink's mavwp.py.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>

#include "io/mavlink/enums.hpp"
#include "io/mavlink/waypoint_file/format.hpp"

namespace godwit::io::mavlink {

enum class waypoint_format { version_100, version_110 };

// Where each of waypoint_column stands in a line of version 100.
inline constexpr std::array<std::size_t, waypoint_columns.size()> column_of_100{0, 7, 1, 2, 5, 6, 3, 4, 9, 8, 10, 12};

[[nodiscard]] constexpr std::optional<std::uint16_t> command_of_100(std::uint16_t action) {
  struct row {
    std::uint16_t action;
    mav_cmd command;
  };
  constexpr row rows[] = {
      {2, mav_cmd::nav_takeoff},       {3, mav_cmd::nav_return_to_launch}, {4, mav_cmd::nav_land},
      {24, mav_cmd::nav_takeoff},      {25, mav_cmd::nav_waypoint},        {26, mav_cmd::nav_land},
      {27, mav_cmd::nav_loiter_unlim},
  };
  const auto* const found = std::ranges::find(rows, action, &row::action);
  return found == std::end(rows) ? std::nullopt : std::optional(number(found->command));
}

} // namespace godwit::io::mavlink
