// Durations for people. Thread: pure.
#pragma once

#include <cstdint>
#include <string>

namespace godwit::daemon {

// "0.4 s", "12 s", "3 min", "5 h 20 min", "3 days"; of a negative one "0 s".
[[nodiscard]] std::string duration_text(std::int64_t duration_ns);

} // namespace godwit::daemon
