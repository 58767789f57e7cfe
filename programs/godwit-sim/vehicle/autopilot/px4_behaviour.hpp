// What PX4 does with its messages beyond their definition, as it was recorded.
#pragma once

#include <cstdint>
#include <optional>
#include <random>
#include <variant>

#include "io/mavlink/messages/mission.hpp"
#include "programs/godwit-sim/vehicle/autopilot/names.hpp"
#include "programs/godwit-sim/vehicle/autopilot/world_clock.hpp"

namespace godwit::sim {

// What PX4 may say just after it has taken another plan, before its parts agree: news of the old one.
//
// Which of them, and whether before or after the acknowledgement, is drawn for each change of a plan. Thread: one at
// a time. Source: messages of real flights.
class stale_messages {
public:
  using message = std::variant<io::mavlink::mission_current, io::mavlink::mission_item_reached>;

  struct plan_before {
    int current = 0;
    std::optional<int> last_reached;
  };

  // NOW_SAYS: what is true of the new one.
  // The message to send before the acknowledgement, if there is one.
  [[nodiscard]] std::optional<message> on_switch(const plan_before& old, const io::mavlink::mission_current& now_says,
                                                 std::mt19937_64& random);
  // The one to send after it.
  [[nodiscard]] std::optional<message> take_late();

private:
  std::optional<message> late_;
};

// A PX4 that has heard sticks (MANUAL_CONTROL) misses them: it holds for a moment, and then returns, also when they are
// heard again.
//
//   no sticks ──heard──> heard ──silent_ns, armed, not landing──> holds ──holds_ns──> returns, once
//
// Source: PX4 1.18 (SIH) with a station that streamed neutral sticks at 10 Hz until the mission began, and again 1.4 s
// later: "Failsafe activated: entering Hold for 5 seconds" 1.05 s after the last one, "Failsafe activated" and
// AUTO.RTL 5.07 s after that. COM_RC_LOSS_T (1 s in its simulator's start script), COM_FAIL_ACT_T, NAV_RCL_ACT. Time:
// the world's, of a wait outside of it (world_clock.hpp). Thread: one at a time.
class stick_loss {
public:
  enum class step { none, holds, returns };
  static constexpr std::int64_t silent_ns = ns_per_s;
  static constexpr std::int64_t holds_ns = 5 * ns_per_s;

  void hear(const instant& now) {
    if (returns_at_ns_ == never_ns)
      lost_at_ns_ = now.world_after(silent_ns);
  }
  void forget() { lost_at_ns_ = returns_at_ns_ = never_ns; }
  [[nodiscard]] std::int64_t next_ns() const { return lost_at_ns_ < returns_at_ns_ ? lost_at_ns_ : returns_at_ns_; }
  // MAY_ACT: it is armed, and nothing else ends its flight.
  [[nodiscard]] step due(const instant& now, bool may_act) {
    if (now.world_ns < next_ns())
      return step::none;
    const bool returns = returns_at_ns_ != never_ns;
    forget();
    if (!may_act)
      return step::none;
    if (!returns)
      returns_at_ns_ = now.world_after(holds_ns);
    return returns ? step::returns : step::holds;
  }

private:
  std::int64_t lost_at_ns_ = never_ns; // never: none were heard
  std::int64_t returns_at_ns_ = never_ns;
};

// MISSION_ITEM_REACHED as PX4 sends it: at once, and then again each second, for the last item that was reached.
// World time. Thread: one at a time.
class repeated_reached {
public:
  static constexpr int max_repetitions = 10;
  static constexpr std::int64_t period_ns = ns_per_s;

  void reach(int sequence, std::int64_t now_ns) {
    sequence_ = sequence;
    left_ = max_repetitions;
    next_ns_ = now_ns + period_ns;
  }
  void forget() { left_ = 0; }
  // Of the plan that is flown; it is not forgotten.
  [[nodiscard]] std::optional<int> last() const { return sequence_; }

  [[nodiscard]] std::int64_t next_ns() const { return left_ > 0 ? next_ns_ : never_ns; }
  // The sequence to tell again, if it is time.
  [[nodiscard]] std::optional<int> due(std::int64_t now_ns) {
    if (now_ns < next_ns())
      return std::nullopt;
    --left_;
    next_ns_ += period_ns;
    return sequence_;
  }

private:
  std::optional<int> sequence_;
  int left_ = 0;
  std::int64_t next_ns_ = 0;
};

} // namespace godwit::sim
