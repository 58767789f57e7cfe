// What the people of a missions service do, and not its vehicles: new missions, new assignments, what is on the map.
//
// Each is one transaction. Errors: a sentence, and nothing has changed. Thread: the file's.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "messages/mission/change.hpp"
#include "messages/mission/document.hpp"
#include "messages/mission/map_objects.hpp"
#include "programs/godwit-sim/missions/assignment_table.hpp"
#include "programs/godwit-sim/missions/service_file.hpp"

namespace godwit::sim::missions::service_operations {

using done = tl::expected<void, std::string>;

[[nodiscard]] done add_mission(service_file& file, const mission::document& mission);
[[nodiscard]] done delete_mission(service_file& file, const std::string& mission_id, std::int64_t now_ns);

// The items must fit when the base is the mission's revision; a stale one is taken as it is.
[[nodiscard]] tl::expected<mission::assignment, std::string>
assign(service_file& file, const std::string& mission_id, const assignment_request& wanted, std::uint64_t seed);

[[nodiscard]] done set_map_objects(service_file& file, const std::string& mission_id,
                                   const std::vector<mission::map_object>& objects);
[[nodiscard]] done add_ignored_items(service_file& file, const std::string& mission_id,
                                     const std::vector<mission::ignored_item>& items);

} // namespace godwit::sim::missions::service_operations
