// The calls that deliver rows: progress reports, observations, ignored items. A batch is stored whole or not at all.
//
// Errors: as answers; those of the file are kept by it. Thread: the file's.
#pragma once

#include "programs/godwit-sim/missions/call.hpp"

namespace godwit::sim::missions {

// The number of the last report.
[[nodiscard]] answer get_progress(service_file& file, const call& at);
[[nodiscard]] answer post_progress(service_file& file, const call& at);
[[nodiscard]] answer post_map_objects(service_file& file, const call& at);
[[nodiscard]] answer post_ignored(service_file& file, const call& at);

} // namespace godwit::sim::missions
