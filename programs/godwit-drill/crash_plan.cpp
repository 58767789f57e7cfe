#include "programs/godwit-drill/crash_plan.hpp"

namespace godwit::drill {

void crash_plan::hit(runtime::crash_point point, std::uint32_t actor, std::uint64_t) {
  auto& slot = slots_.at(actor);
  if (const auto crashed_at_ns = slot.crashed_at_ns.load(std::memory_order_relaxed); crashed_at_ns != 0) {
    slot.crashed_at_ns.store(0, std::memory_order_relaxed);
    const std::lock_guard guard(mutex_);
    latencies_ns_.push_back(time_.monotonic_ns() - crashed_at_ns);
  }
  if (slot.armed.load(std::memory_order_relaxed) != static_cast<std::uint8_t>(point))
    return;
  slot.armed.store(idle);
  slot.crashed_at_ns.store(time_.monotonic_ns());
  throw runtime::injected_crash("planned by the drill");
}

std::vector<std::int64_t> crash_plan::latencies_ns() const {
  const std::lock_guard guard(mutex_);
  return latencies_ns_;
}

} // namespace godwit::drill
