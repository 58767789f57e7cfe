// The clock by which pictures are stamped: CLOCK_MONOTONIC, which every process of this computer shares. Thread: any.
#pragma once

#include <cstdint>
#include <ctime>

namespace godwit::io::video {

[[nodiscard]] inline std::int64_t monotonic_ns() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

} // namespace godwit::io::video
