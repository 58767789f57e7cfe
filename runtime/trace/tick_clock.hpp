// The processor's own counter as a clock: reading it costs a third of what a call for the time does, and the trace
// reads it twice for each message.
//
// now() counts ticks that all cores share (x86-64: invariant TSC; AArch64: CNTVCT_EL0); where the processor has no such
// counter it counts nanoseconds of the monotonic clock. tick_scale turns ticks into those nanoseconds; it is measured
// against that clock again and again, so that it follows it. Sources: Intel SDM vol. 3 section 18.17.1; Arm ARM, D11.1.
// Thread: now() any; tick_scale one.
#pragma once

#include <chrono>
#include <cstdint>

#if defined(__x86_64__)
#include <x86intrin.h>
#endif

namespace godwit::runtime::tick_clock {

[[nodiscard]] bool is_processors_own() noexcept;

[[nodiscard]] inline std::int64_t monotonic_ns() noexcept {
  return std::chrono::steady_clock::now().time_since_epoch().count();
}

[[nodiscard]] inline std::int64_t now() noexcept {
#if defined(__x86_64__)
  static const bool own = is_processors_own();
  return own ? static_cast<std::int64_t>(__rdtsc()) : monotonic_ns();
#elif defined(__aarch64__)
  std::int64_t ticks;
  asm volatile("mrs %0, cntvct_el0" : "=r"(ticks));
  return ticks;
#else
  return monotonic_ns();
#endif
}

} // namespace godwit::runtime::tick_clock

namespace godwit::runtime {

class tick_scale {
public:
  // Watches both clocks for SETTLE; longer is more exact until the first adjust().
  explicit tick_scale(std::chrono::microseconds resolve = std::chrono::milliseconds(2));

  // Of a clock that counts nanoseconds by itself, as that of a simulation.
  [[nodiscard]] static tick_scale of_nanoseconds() noexcept { return tick_scale(unmeasured{}); }

  // Measures again over all the time since the start.
  void adjust() noexcept;

  [[nodiscard]] std::int64_t to_monotonic_ns(std::int64_t ticks) const noexcept {
    return last_ns_ + to_duration_ns(ticks - last_ticks_);
  }
  [[nodiscard]] std::int64_t to_duration_ns(std::int64_t ticks) const noexcept {
    return static_cast<std::int64_t>(static_cast<double>(ticks) * ns_per_tick_);
  }

private:
  struct unmeasured {};
  explicit tick_scale(unmeasured) noexcept : is_measured_(false) {}

  bool is_measured_ = true;
  std::int64_t first_ticks_ = 0;
  std::int64_t first_ns_ = 0;
  std::int64_t last_ticks_ = 0;
  std::int64_t last_ns_ = 0;
  double ns_per_tick_ = 1;
};

} // namespace godwit::runtime
