#include "runtime/trace/tick_clock.hpp"

#include <thread>

#if defined(__x86_64__)
#include <cpuid.h>
#endif

namespace godwit::runtime {

bool tick_clock::is_processors_own() noexcept {
#if defined(__x86_64__)
  constexpr unsigned power_management_leaf = 0x80000007;
  constexpr unsigned invariant_tsc = 1U << 8U;
  unsigned eax = 0;
  unsigned ebx = 0;
  unsigned ecx = 0;
  unsigned edx = 0;
  return __get_cpuid(power_management_leaf, &eax, &ebx, &ecx, &edx) != 0 && (edx & invariant_tsc) != 0;
#elif defined(__aarch64__)
  return true;
#else
  return false;
#endif
}

tick_scale::tick_scale(std::chrono::microseconds resolve)
    : first_ticks_(tick_clock::now()), first_ns_(tick_clock::monotonic_ns()) {
  std::this_thread::sleep_for(resolve);
  adjust();
}

void tick_scale::adjust() noexcept {
  if (!is_measured_)
    return;
  const auto ticks = tick_clock::now();
  const auto ns = tick_clock::monotonic_ns();
  if (ticks <= first_ticks_ || ns <= first_ns_)
    return;
  last_ticks_ = ticks;
  last_ns_ = ns;
  ns_per_tick_ = static_cast<double>(ns - first_ns_) / static_cast<double>(ticks - first_ticks_);
}

} // namespace godwit::runtime
