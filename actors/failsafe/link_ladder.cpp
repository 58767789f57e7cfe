#include "actors/failsafe/link_ladder.hpp"

#include <algorithm>

namespace godwit::failsafe {

link_ladder::link_ladder(const settings& configured, const link_memory& restored, instant now)
    : settings_(configured), memory_(restored), heard_ns_(now.monotonic_ns) {
  if (!memory_.silent_since_ns)
    return;
  const auto longest_ns = std::max<std::int64_t>(lost_after_ms() - link_restart_grace_ms, 0) * ns_per_ms;
  heard_ns_ -= std::clamp<std::int64_t>(now.wall_ns - *memory_.silent_since_ns, 0, longest_ns);
}

std::int64_t link_ladder::lost_after_ms() const {
  return settings_.link_lost_ms + (memory_.following ? settings_.following_extra_ms : 0);
}

void link_ladder::on_report(bool ever_heard, std::int64_t age_ms, instant now) {
  if (!ever_heard || age_ms < 0)
    return;
  if (age_ms < settings_.link_degraded_ms)
    memory_.silence_is_known = false;
  memory_.seen = true;
  if (age_ms < now.monotonic_ns / ns_per_ms) // else older than this computer's run, and than the start
    heard_ns_ = std::max(heard_ns_, now.monotonic_ns - age_ms * ns_per_ms);
}

bool link_ladder::on_hand_back(instant now) {
  if (evaluate(now) != link_phase::lost)
    return false;
  memory_.silence_is_known = true;
  heard_ns_ = now.monotonic_ns;
  return true;
}

link_phase link_ladder::evaluate(instant now) {
  const auto phase = [&] {
    if (settings_.operator_link == operator_link_policy::off)
      return link_phase::off;
    if (settings_.operator_link == operator_link_policy::once_seen && (!memory_.seen || memory_.silence_is_known))
      return link_phase::never_seen;
    const auto silent_ns = now.monotonic_ns - heard_ns_;
    if (silent_ns >= lost_after_ms() * ns_per_ms)
      return link_phase::lost;
    return silent_ns >= settings_.link_degraded_ms * ns_per_ms ? link_phase::degraded : link_phase::ok;
  }();
  if (phase != link_phase::degraded && phase != link_phase::lost)
    memory_.silent_since_ns.reset();
  else if (!memory_.silent_since_ns)
    memory_.silent_since_ns = now.wall_ns - (now.monotonic_ns - heard_ns_);
  return phase;
}

} // namespace godwit::failsafe
