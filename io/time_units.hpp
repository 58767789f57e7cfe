// How many of a unit of time another one has, and a moment on both clocks. Thread: plain values.
#pragma once

#include <cstdint>

namespace godwit {

inline constexpr std::int64_t ns_per_us = 1'000;
inline constexpr std::int64_t ns_per_ms = 1'000'000;
inline constexpr std::int64_t ns_per_s = 1'000'000'000;

// All that is measured goes by the monotonic clock, which never jumps: a correction of the wall clock must not make a
// link lost. The wall clock is for what has to keep its meaning when the computer starts again, such as the deadline
// that an operator set.
struct instant {
  std::int64_t monotonic_ns = 0;
  std::int64_t wall_ns = 0; // since 1970 (UTC)
};

} // namespace godwit
