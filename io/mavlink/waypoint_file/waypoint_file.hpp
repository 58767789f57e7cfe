// Plan files on the disk. The text in them is the business of waypoint_reader.hpp and waypoint_writer.
//
// Errors: as values with the path; `io` for what the system refuses. Blocks on the disk. Thread: any.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "io/mavlink/enums/mission.hpp"
#include "io/mavlink/messages/mission_transfer.hpp"
#include "io/mavlink/waypoint_file/waypoint_error.hpp"

namespace godwit::io::mavlink {

[[nodiscard]] waypoint_result<std::vector<mission_item_int>>
load_waypoint_file(const std::filesystem::path& path, mav_mission_type type = mav_mission_type::mission);

// Beside PATH first and then moved over it: a file that is there already stays as it is if this fails.
[[nodiscard]] waypoint_result<void> save_waypoint_file(const std::filesystem::path& path,
                                                       std::span<const mission_item_int> items);

// Writes items as the text of a plan file, which reads back as the same items.
//
// Parted by tabs, lines end with a line feed, numbers have as many digits as it takes and no more. What a file can not
// say is left out: the targets and the type of plan. Items that no reader would take are refused, with the line on
// which they would stand: a seq that does not count from 0, an unknown frame, a position that is not on earth, an
// infinity. Errors: as values. Thread: pure.
[[nodiscard]] waypoint_result<std::string> write_waypoints(std::span<const mission_item_int> items);

} // namespace godwit::io::mavlink
