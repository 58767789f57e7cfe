// Reads the text of a plan file into the items of an upload. What is not understood is refused with line and column,
// and nothing is guessed.
//
// Accepted: the versions 100 (columns and actions of its own), 110 and 120 (the same form); whole numbers with a
// decimal point (16.0); CRLF, a byte order mark in front, a last line without an end, blank lines and comments (from #
// to the end of a line) anywhere; NaN in the parameters and in z, where MAVLink gives it a meaning (leave it to the
// vehicle). The items are numbered as they stand, whatever their indexes are, as ArduPilot's tools do it; a plan with a
// DO_JUMP has to count from 0. Not: an infinity. A file without items is a plan of none. The file does not say which of
// a vehicle's plans it is; every item gets TYPE. Targets stay 0. Degrees and metres as in format.hpp. Errors: as
// values, the first one found. Thread: pure.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "io/mavlink/enums/mission.hpp"
#include "io/mavlink/messages/mission_transfer.hpp"
#include "io/mavlink/waypoint_file/waypoint_error.hpp"

namespace godwit::io::mavlink {

struct plan_lines {
  std::vector<mission_item_int> items;
  std::vector<std::size_t> lines; // of each item, from 1 on
};

[[nodiscard]] waypoint_result<plan_lines> read_plan_lines(std::string_view text,
                                                          mav_mission_type type = mav_mission_type::mission);

[[nodiscard]] waypoint_result<std::vector<mission_item_int>>
read_waypoints(std::string_view text, mav_mission_type type = mav_mission_type::mission);

} // namespace godwit::io::mavlink
