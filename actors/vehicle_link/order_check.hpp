// Whether an order may still go out: what its sender saw when it decided is held against what is known here.
//
// Four things make it outdated. The vehicle has another mode or armed state than its sender saw. Somebody else has
// acted on the vehicle since it was looked at for an order that moves it (messages/vehicle_link/evidence.hpp). The look
// at the vehicle on which it was decided is older than look_counts_ns: this process stood still, or the disk did. Or
// the failsafe has commanded the vehicle since, and the sender did not know of it: such an order would undo the
// failsafe's, in the time in which no heartbeat shows that yet. The failsafe's commands have rising numbers; an order
// says the last of them that its sender knows of, and the failsafe's own say theirs. After the time in which a
// heartbeat must have come only the mode counts: a number that was lost with a crash keeps nobody out for good.
//
// Times: monotonic nanoseconds. Thread: a plain value.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string_view>

#include "messages/vehicle_link/command.hpp"

namespace godwit::vehicle_link {

class order_check {
public:
  static constexpr std::int64_t failsafe_counts_ns = 5'000'000'000;

  void heard(std::uint32_t custom_mode, bool is_armed) { seen_ = {custom_mode, is_armed}; }
  void forget_seen() { seen_.reset(); }
  void heard_mode(std::uint32_t custom_mode) {
    if (seen_)
      seen_->custom_mode = custom_mode;
  }

  // Somebody else acts on the vehicle, or brings it a plan.
  void heard_foreign(std::int64_t at_ns) { foreign_ns_ = at_ns; }

  // Why it must not go out; empty: it may, and what it knows of the failsafe counts from now on.
  [[nodiscard]] std::string_view why_not(const std::optional<seen_state>& decided, std::int64_t now_ns) {
    if (!decided)
      return {};
    if (seen_ && (decided->custom_mode != seen_->custom_mode || decided->is_armed != seen_->is_armed))
      return count("the vehicle has changed its mode, or was armed or disarmed");
    const bool moves = decided->looked_ns != 0;
    if (moves && std::max(decided->foreign_ns, decided->looked_ns) < foreign_ns_)
      return count("somebody else has acted on the vehicle");
    if (moves && now_ns - decided->looked_ns > look_counts_ns)
      return count("the newest observation of the vehicle is older than a second");
    if (decided->failsafe_command < failsafe_command_ && now_ns - commanded_ns_ < failsafe_counts_ns)
      return count("the failsafe has commanded the vehicle since");
    if (decided->failsafe_command != failsafe_command_)
      commanded_ns_ = now_ns;
    failsafe_command_ = decided->failsafe_command;
    return {};
  }

  [[nodiscard]] bool is_surely_disarmed() const { return seen_ && !seen_->is_armed; }
  [[nodiscard]] std::uint64_t kept_back() const { return kept_back_; }

private:
  std::string_view count(std::string_view why) {
    ++kept_back_;
    return why;
  }

  std::optional<seen_state> seen_; // the newest that the vehicle has told
  std::int64_t foreign_ns_ = 0;    // the newest act of somebody else
  std::uint64_t failsafe_command_ = 0;
  std::int64_t commanded_ns_ = 0;
  std::uint64_t kept_back_ = 0; // orders
};

} // namespace godwit::vehicle_link
