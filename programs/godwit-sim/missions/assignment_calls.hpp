// The calls about assignments: asking for them, and answering one.
//
// Errors: as answers; those of the file are kept by it. Thread: the file's.
#pragma once

#include "programs/godwit-sim/missions/call.hpp"

namespace godwit::sim::missions {

// What there is now. The body is empty when that is nothing; empty_assignments then ends the wait.
[[nodiscard]] answer get_assignments(service_file& file, const call& at);
[[nodiscard]] answer empty_assignments();

[[nodiscard]] answer post_response(service_file& file, const call& at);

} // namespace godwit::sim::missions
