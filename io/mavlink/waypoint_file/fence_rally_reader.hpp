// Reads the files in which MAVProxy and Mission Planner keep a fence (.fen) and rally points, into the items of an
// upload of that type. They have no header:
//
//   LATITUDE LONGITUDE                                   a fence: the point of return, then the corners of one
//                                                        polygon to stay inside of; the last repeats the first
//   RALLY LATITUDE LONGITUDE ALTITUDE BREAK DIRECTION FLAGS   a rally point
//
// Degrees, and metres above home. Comments, blank lines, CRLF and a byte order mark make no difference. The break
// altitude, the direction of landing and the flags of a rally point have no place in an item; ArduPilot drops them,
// too. Errors: as values, the first one found. Thread: pure. Source: pymavlink's mavwp.py, MAVFenceLoader and
// MAVRallyLoader.
#pragma once

#include <optional>
#include <string_view>

#include "io/mavlink/enums/mission.hpp"
#include "io/mavlink/waypoint_file/waypoint_error.hpp"
#include "io/mavlink/waypoint_file/waypoint_reader.hpp"

namespace godwit::io::mavlink {

// What TEXT looks like by its first line; nothing: it is neither.
[[nodiscard]] std::optional<mav_mission_type> fence_or_rally(std::string_view text);

[[nodiscard]] waypoint_result<plan_lines> read_fence_lines(std::string_view text);
[[nodiscard]] waypoint_result<plan_lines> read_rally_lines(std::string_view text);

} // namespace godwit::io::mavlink
