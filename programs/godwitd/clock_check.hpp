// Whether the clocks of this computer can be counted in nanoseconds: 64 bits of them end in the year 2262.
//
// Thread: pure, but for clock_now.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace godwit::daemon {

struct clock_reading {
  std::int64_t wall_s = 0;      // since 1970 UTC
  std::int64_t monotonic_s = 0; // of CLOCK_MONOTONIC
};

[[nodiscard]] clock_reading clock_now();

// Why godwitd can not run on it, as a sentence for people. Room for a century is kept.
[[nodiscard]] std::optional<std::string> objection_to_clock(const clock_reading& now);

} // namespace godwit::daemon
