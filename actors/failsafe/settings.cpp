#include "actors/failsafe/settings.hpp"

#include <cmath>

namespace godwit::failsafe {

std::optional<std::string> objection_to(const settings& configured) {
  const auto& s = configured;
  if (s.battery_critical_percent < 0 || s.battery_low_percent > 100)
    return "battery_critical_percent and battery_low_percent lie between 0 and 100";
  if (s.battery_critical_percent > s.battery_low_percent)
    return "battery_critical_percent must not be above battery_low_percent";
  if (s.link_degraded_ms <= 0 || s.link_degraded_ms > s.link_lost_ms)
    return "link_degraded_ms must be above 0 and not above link_lost_ms";
  if (s.following_extra_ms < 0)
    return "following_extra_ms must not be below 0";
  if (!std::isfinite(s.moving_mps) || s.moving_mps <= 0)
    return "moving_mps must be above 0";
  return std::nullopt;
}

} // namespace godwit::failsafe
