// The calls that pull the map, page by page. Errors: as answers; those of the file are kept by it. Thread: the file's.
#pragma once

#include "programs/godwit-sim/missions/call.hpp"

namespace godwit::sim::missions {

[[nodiscard]] answer get_map_objects(service_file& file, const call& at);
[[nodiscard]] answer get_ignored(service_file& file, const call& at);

} // namespace godwit::sim::missions
