// The runtime drill: a million messages through supervised actors while they are crashed a thousand times, then the
// count.
//
//   source ──> relay 1..4 ──> ledger 1..4 ──> auditor        every tenth message: a row in drill_effect and a durable
//   receipt
//
// Crashes come evenly over the run, at an actor and a point drawn from the seed: before the handler, after it, after
// the commit, before an effect goes out; and between two messages (a kill). Some messages crash every handler and must
// end as dead letters. What is counted is told by the audit (outside the actors) and by the journal's tables; `sent =
// handled + dead_lettered + lost`. Thread: run_runtime_drill blocks; one at a time.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>
#include <tl/expected.hpp>

#include "runtime/clock.hpp"
#include "runtime/crash_points.hpp"
#include "runtime/process.hpp"

namespace godwit::drill {

struct runtime_drill_options {
  std::uint64_t messages = 1'000'000;
  std::uint64_t crashes = 1'000;
  std::uint64_t seed = 1;
  runtime::process_options process; // journal and trace: where they go
};

struct runtime_drill_result {
  std::uint64_t sent = 0;
  std::uint64_t handled = 0;
  std::uint64_t dead_lettered = 0;
  std::uint64_t lost = 0;             // neither handled nor a dead letter
  std::uint64_t doubled = 0;          // handled again, or more than one row in drill_effect
  std::uint64_t effects_expected = 0; // durable messages handled
  std::uint64_t effects_found = 0;    // rows in drill_effect
  std::uint64_t crashes = 0;
  std::uint64_t restarts = 0;
  double restart_p50_us = 0;
  double restart_p99_us = 0;
  double restart_max_us = 0;
  std::uint64_t trace_records = 0;
  std::uint64_t trace_dropped = 0;
  std::uint64_t journal_commits = 0;
  double seconds = 0;

  [[nodiscard]] bool passed() const { return lost == 0 && doubled == 0 && effects_expected == effects_found; }
};

// The error is a sentence for people.
[[nodiscard]] tl::expected<runtime_drill_result, std::string> run_runtime_drill(runtime_drill_options options);

[[nodiscard]] nlohmann::json to_json(const runtime_drill_result& result, std::uint64_t seed);

// The drill's table for people. Thread: pure.
[[nodiscard]] std::string to_table(const runtime_drill_result& result);

// Crashes the drill's actors at chosen points and measures how long each is away.
//
// arm() plans one crash of an actor; the next time it passes the point it throws. The time from there to the next
// message that the actor begins is the restart latency. Thread: any.
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
