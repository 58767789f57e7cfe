// Crashes the drill's actors at chosen points and measures how long each is away.
//
// arm() plans one crash of an actor; the next time it passes the point it throws. The time from there to the next
// message that the actor begins is the restart latency. Thread: any.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <mutex>
#include <vector>

#include "runtime/clock.hpp"
#include "runtime/crash_points.hpp"

namespace godwit::drill {

class crash_plan final : public runtime::crash_points {
public:
  static constexpr std::size_t max_actors = 64;

  explicit crash_plan(const runtime::time_source& time) : time_(time) {}

  // False when a crash of this actor is still outstanding.
  bool arm(std::uint32_t actor, runtime::crash_point point) {
    auto none = idle;
    return slots_.at(actor).armed.compare_exchange_strong(none, static_cast<std::uint8_t>(point));
  }
  void disarm_all() {
    for (auto& each : slots_)
      each.armed.store(idle);
  }

  void hit(runtime::crash_point point, std::uint32_t actor, std::uint64_t message) override;

  // An actor crashed by itself (a poisoned message).
  void note_crash(std::uint32_t actor) { slots_.at(actor).crashed_at_ns.store(time_.monotonic_ns()); }

  [[nodiscard]] std::vector<std::int64_t> latencies_ns() const;

private:
  static constexpr std::uint8_t idle = 0xFF;

  struct alignas(64) actor_slot {
    std::atomic<std::uint8_t> armed{idle};
    std::atomic<std::int64_t> crashed_at_ns{0}; // 0 = alive
  };

  const runtime::time_source& time_;
  std::array<actor_slot, max_actors> slots_;
  mutable std::mutex mutex_; // latencies_ns_
  std::vector<std::int64_t> latencies_ns_;
};

} // namespace godwit::drill
