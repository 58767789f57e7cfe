// What the operating system says about this process. Where it does not tell, a figure is 0.
//
// Reads /proc and asks no disk. Thread: any. Source: proc(5), getrusage(2), getrlimit(2).
#pragma once

#include <cstdint>

#include "actors/health/report.hpp"

namespace godwit::daemon {

// Without the free bytes of the disk. BEGAN_MS: since 1970 (UTC).
[[nodiscard]] health::process_figures look_at_process(std::int64_t began_ms);

} // namespace godwit::daemon
