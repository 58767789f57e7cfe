// A PX4 that has heard sticks (MANUAL_CONTROL) misses them: it holds for a moment, and then returns, also when they are
// heard again.
//
//   no sticks ──heard──> heard ──silent_ns, armed, not landing──> holds ──holds_ns──> returns, once
//
// Source: PX4 1.18 (SIH) with a station that streamed neutral sticks at 10 Hz until the mission began, and again 1.4 s
// later: "Failsafe activated: entering Hold for 5 seconds" 1.05 s after the last one, "Failsafe activated" and
// AUTO.RTL 5.07 s after that. COM_RC_LOSS_T (1 s in its simulator's start script), COM_FAIL_ACT_T, NAV_RCL_ACT. Time:
// the world's, of a wait outside of it (world_clock.hpp). Thread: one at a time.
#pragma once

#include <cstdint>

#include "programs/godwit-sim/vehicle/autopilot/world_clock.hpp"

namespace godwit::sim {

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

} // namespace godwit::sim
