// The plan file of ground stations: text, a header and one item a line.
//
//   QGC WPL 110
//   INDEX CURRENT FRAME COMMAND PARAM1 PARAM2 PARAM3 PARAM4 X Y Z AUTOCONTINUE
//
// Columns are parted by tabs or spaces. X and Y are degrees (latitude, longitude) in the global frames, metres in the
// local ones, and two whole numbers in frame 2, which has no position; Z is metres, or a seventh parameter. Source: the
// MAVLink guide, "File Formats" (plain-text file format); what QGroundControl and Mission Planner write. Thread:
// constants.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace godwit::io::mavlink {

inline constexpr std::string_view waypoint_magic = "QGC WPL";
inline constexpr std::string_view waypoint_version = "110";

// In the order of the file, named for people.
enum class waypoint_column {
  index,
  current,
  frame,
  command,
  param1,
  param2,
  param3,
  param4,
  x,
  y,
  z,
  autocontinue,
};

inline constexpr std::array<std::string_view, 12> waypoint_columns{"index",  "current", "frame",  "command",
                                                                   "param1", "param2",  "param3", "param4",
                                                                   "x/lat",  "y/lon",   "z/alt",  "autocontinue"};

[[nodiscard]] constexpr std::string_view name_of(waypoint_column column) {
  return waypoint_columns[static_cast<std::size_t>(column)];
}

inline constexpr std::size_t max_waypoint_items = 65'535;      // what MISSION_COUNT can say
inline constexpr std::size_t max_waypoint_line_bytes = 512;    // a line with all its digits has some 200
inline constexpr std::size_t max_waypoint_blank_lines = 1'024; // and comments
inline constexpr std::size_t max_waypoint_file_bytes =
    (max_waypoint_items + 1 + max_waypoint_blank_lines) * (max_waypoint_line_bytes + 2);

} // namespace godwit::io::mavlink
