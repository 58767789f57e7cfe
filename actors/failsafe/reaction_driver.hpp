// Brings a reaction to the vehicle: sends, waits, looks, sends again; see reaction.hpp for the phases.
//
// After a restart a command that was in flight is waited for as if it had just gone out: it can still reach the
// vehicle, and a second one after it would be a second return. Monotonic nanoseconds. Thread: pure.
#pragma once

#include <cstdint>
#include <optional>

#include "actors/failsafe/events.hpp"
#include "actors/failsafe/reaction.hpp"
#include "actors/failsafe/rules.hpp"
#include "messages/failsafe/types.hpp"
#include "messages/vehicle_link/command.hpp"

namespace godwit::failsafe {

// vehicle_link answers within a second. Later than this nobody answers any more, and the command is not under way.
inline constexpr std::int64_t command_answer_ms = 3'000;
// What was accepted shows in one of the next heartbeats, which come once a second.
inline constexpr std::int64_t obedience_ms = 3'000;

class reaction_driver {
public:
  reaction_driver(const std::optional<reaction>& restored, std::uint64_t last_number, std::int64_t now_ns);

  // In place of what was done before.
  void begin(rule why, action what);
  // Another rule wants the same; the higher of the two counts. Only while there is a reaction.
  void raise(rule why);
  void drop() { current_.reset(); }

  void on_resolved(const command_resolved& what);

  struct look {
    mode_kind mode = mode_kind::unknown;
    std::int64_t heartbeat_ns = 0; // when it was seen
    bool may_send = false;
    bool is_ours = true;          // no pilot has changed the mode
    bool on_landing = false;      // the plan is at its landing, or after it
    std::int64_t sequence_ns = 0; // when that was seen
  };
  struct step {
    std::optional<command_vehicle> send;
    bool fails_first = false; // it did not get through, for the first time
    bool disobeyed = false;   // accepted, and the mode did not follow; said once
    bool was_left = false;    // it was done, and a command of ours on its way led out of it
  };
  // Once at each tick.
  [[nodiscard]] step drive(const look& seen, std::int64_t now_ns);

  [[nodiscard]] const std::optional<reaction>& current() const { return current_; }
  [[nodiscard]] std::uint64_t last_number() const { return last_number_; }
  // Only while there is a reaction. Failing: it has not got through, or was accepted and not obeyed.
  [[nodiscard]] reaction_stage stage() const;

private:
  void resolve(const look& seen, std::int64_t now_ns);
  [[nodiscard]] bool is_done(const look& seen) const;
  [[nodiscard]] bool is_left(const look& seen) const;
  [[nodiscard]] bool is_disobeyed(const look& seen, std::int64_t now_ns) const;
  void look_again(const look& seen, std::int64_t now_ns);
  void take_verdict(vehicle_link::command_verdict verdict, std::int64_t now_ns);
  void enter(reaction_phase phase, std::int64_t now_ns);
  [[nodiscard]] bool is_overdue(std::int64_t limit_ms, std::int64_t now_ns) const;

  std::optional<reaction> current_;
  std::uint64_t last_number_ = 0;
  std::int64_t since_ns_ = 0;                            // in this phase
  std::optional<vehicle_link::command_verdict> verdict_; // came since the last tick
  bool failed_ = false;                                  // and has not got through since
  bool said_disobeyed_ = false;
};

} // namespace godwit::failsafe
