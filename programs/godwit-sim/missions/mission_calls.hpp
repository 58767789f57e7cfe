// The calls about the mission itself: fetching, deleting, inserting a waypoint, replacing its end.
//
// Errors: as answers; those of the file are kept by it. Thread: the file's.
#pragma once

#include "programs/godwit-sim/missions/call.hpp"

namespace godwit::sim::missions {

[[nodiscard]] answer get_mission(service_file& file, const call& at);
[[nodiscard]] answer remove_mission(service_file& file, const call& at);
[[nodiscard]] answer post_waypoint(service_file& file, const call& at);
[[nodiscard]] answer post_tail(service_file& file, const call& at);

} // namespace godwit::sim::missions
