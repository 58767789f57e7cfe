// Whether a vehicle flies, as the executor has left it in the journal: for what has to be decided before it runs.
// Thread: pure.
#pragma once

#include "runtime/journal/records.hpp"

namespace godwit::daemon {

// EXECUTOR: what the journal has of it. What can not be read is no flight; the executor says why.
[[nodiscard]] bool is_in_flight(const runtime::recovered& executor);

} // namespace godwit::daemon
