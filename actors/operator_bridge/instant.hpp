// The moment of an event on both clocks. What is measured goes by the monotonic clock, which never jumps; deadlines of
// commands and ends of sessions are told by the wall clock (nanoseconds since 1970, UTC). Thread: plain values.
#pragma once

#include <cstdint>

#include "io/time_units.hpp"

namespace godwit::operator_bridge {

struct instant {
  std::int64_t monotonic_ns = 0;
  std::int64_t wall_ns = 0;
};

} // namespace godwit::operator_bridge
