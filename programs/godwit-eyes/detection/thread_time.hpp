// Processor time of the thread that asks.
#pragma once

#include <cstdint>
#include <ctime>

namespace godwit::eyes {

[[nodiscard]] inline std::int64_t thread_ns() {
  timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return now.tv_sec * 1'000'000'000 + now.tv_nsec;
}

[[nodiscard]] inline double thread_ms() { return static_cast<double>(thread_ns()) * 1e-6; }

} // namespace godwit::eyes
