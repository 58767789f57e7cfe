// Writes items as the text of a plan file, which reads back as the same items.
//
// Parted by tabs, lines end with a line feed, numbers have as many digits as it takes and no more. What a file can not
// say is left out: the targets and the type of plan. Items that no reader would take are refused, with the line on
// which they would stand: a seq that does not count from 0, an unknown frame, a position that is not on earth, an
// infinity. Errors: as values. Thread: pure.
#pragma once

#include <span>
#include <string>

#include "io/mavlink/messages/mission_transfer.hpp"
#include "io/mavlink/waypoint_file/waypoint_error.hpp"

namespace godwit::io::mavlink {

[[nodiscard]] waypoint_result<std::string> write_waypoints(std::span<const mission_item_int> items);

} // namespace godwit::io::mavlink
