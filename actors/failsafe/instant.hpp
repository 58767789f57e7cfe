// The moment of an event on both clocks.
//
// All that is measured goes by the monotonic clock, which never jumps: a correction of the wall clock must not make a
// link lost. The wall clock is for what has to keep its meaning when the computer starts again, such as the deadline
// that an operator set. Nanoseconds; the wall clock counts since 1970 (UTC). Thread: plain values.
#pragma once

#include <cstdint>

#include "io/time_units.hpp"

namespace godwit::failsafe {

using godwit::ns_per_ms;
using godwit::ns_per_s;

struct instant {
  std::int64_t monotonic_ns = 0;
  std::int64_t wall_ns = 0;
};

// All decisions fall on a tick. From a breach to the command it takes at most one of them.
inline constexpr std::int64_t tick_ms = 100;

} // namespace godwit::failsafe
