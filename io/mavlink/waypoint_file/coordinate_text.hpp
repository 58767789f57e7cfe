// X and Y of an item: the integers of MISSION_ITEM_INT and the text of a plan file, exact in both directions.
//
//   coordinates   text           integer
//   global        degrees        degrees times 1e7
//   local         metres         metres times 1e4
//   none          whole number   the same
//
// An integer is written with all its decimals (7 or 4) and reads back as itself; text with more decimals is rounded to
// the nearest integer. Errors: code and sentence; line and column are the caller's. Thread: pure. Source: MAVLink's
// common.xml, MISSION_ITEM_INT.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "io/mavlink/frame_meaning.hpp"
#include "io/mavlink/waypoint_file/waypoint_error.hpp"

namespace godwit::io::mavlink {

enum class axis { x, y };

[[nodiscard]] tl::expected<std::int32_t, waypoint_error> read_coordinate(coordinate_kind kind, axis which,
                                                                         std::string_view text);

// Refused: what lies outside of 90 degrees of latitude or 180 of longitude.
[[nodiscard]] tl::expected<void, waypoint_error> append_coordinate(std::string& out, coordinate_kind kind, axis which,
                                                                   std::int32_t value);

} // namespace godwit::io::mavlink
