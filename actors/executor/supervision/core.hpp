// The executor's supervision of the other actors: which table holds, who runs, and what follows when somebody is given
// up. The guardian carries it out (runtime/supervision/guardian.hpp).
//
//   durable in_flight ──held for 5 s──> part ──> table with an epoch ──> guardian, until it is acknowledged
//   child_event, children ──> who runs ──> preflight check, announcements, what follows without a failsafe
//
// A new incarnation takes the durable state as it is, and asks the guardian for the children. Pure: time comes in.
// Thread: one owner.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "actors/executor/effects.hpp"
#include "actors/executor/preflight/facts.hpp"
#include "actors/executor/supervision/state.hpp"
#include "actors/executor/supervision/table.hpp"
#include "runtime/supervision/messages.hpp"

namespace godwit::executor::supervision {

// A landing that is followed by the next take-off at once is no part of its own.
inline constexpr std::int64_t part_holds_ns = 5'000'000'000;
// The process ends within 500 ms of giving up the failsafe, if it ends: then the next one decides.
inline constexpr std::int64_t gone_holds_ns = 1'000'000'000;

class core {
public:
  // INCARNATION: of the executor. CHILDREN: of the process, in start order.
  core(circumstances process, std::uint64_t incarnation, std::vector<std::string> children);

  // The guardian's answer: how they are. Returns what people have to know.
  [[nodiscard]] std::vector<announce> on_children(const runtime::children& all, std::int64_t now_ns);
  [[nodiscard]] std::vector<announce> on_event(const runtime::child_event& happened, std::int64_t now_ns);
  // Who has come back since the last call, and has heard nothing while it was not wanted or given up.
  [[nodiscard]] std::vector<std::string> take_returned() { return std::exchange(returned_, {}); }
  void on_acknowledged(const runtime::table_epoch& held);

  // To be called often: which part it is now, and whether the mission is one with scanning.
  void look(const state& durable, bool in_flight, bool has_scans, std::int64_t now_ns);
  [[nodiscard]] part now() const { return now_.value_or(part::ground); }
  // Points of interest are looked for.
  [[nodiscard]] bool is_scanning() const { return scans_ && now() == part::flight; }
  // The table that the guardian has not acknowledged yet; none: it holds.
  [[nodiscard]] std::optional<runtime::supervise> unacknowledged() const;

  [[nodiscard]] bool knows_children() const { return knows_children_; }
  // For the preflight check: all that are wanted on the ground and that a flight depends on.
  [[nodiscard]] std::vector<preflight::actor_fact> facts() const;
  // In a flight, for so long that this process goes on without it.
  [[nodiscard]] bool is_failsafe_gone(std::int64_t now_ns) const;
  // The same, and nothing was decided about it in this flight.
  [[nodiscard]] bool misses_failsafe(const state& durable, std::int64_t now_ns) const;

private:
  struct child {
    std::string name;
    bool is_running = false;
    bool is_away = false;                    // not wanted, or given up
    std::optional<std::int64_t> given_up_ns; // since then
  };

  [[nodiscard]] child* find(const std::string& name);
  void give_up(child& each, std::int64_t now_ns);
  void begin(part next, bool has_scans, const state& durable);

  circumstances process_;
  std::vector<child> children_;
  std::vector<std::string> returned_;
  bool knows_children_ = false;
  std::optional<part> now_;
  std::optional<part> next_; // that has not held for long enough
  std::int64_t next_since_ns_ = 0;
  bool scans_ = false; // as the table has it
  runtime::supervise table_;
  runtime::table_epoch acknowledged_;
};

} // namespace godwit::executor::supervision
