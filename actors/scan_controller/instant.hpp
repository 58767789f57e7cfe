// The moment of a decision on both clocks: the monotonic one measures, the wall clock dates. Nanoseconds; the wall
// clock counts since 1970 (UTC). Thread: a plain value.
#pragma once

#include <cstdint>

namespace godwit::scan_controller {

struct instant {
  std::int64_t monotonic_ns = 0;
  std::int64_t wall_ns = 0;
};

} // namespace godwit::scan_controller
