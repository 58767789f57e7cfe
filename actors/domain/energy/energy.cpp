#include "actors/domain/energy/energy.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace godwit::energy {
namespace {

constexpr double ns_per_s = 1e9;

bool is_known(int percent) { return percent >= 0 && percent <= 100; }

bool is_sound(double value) { return std::isfinite(value) && value >= 0; }

} // namespace

pace pace_of(flight::vehicle_class what) {
  switch (what) {
  case flight::vehicle_class::fixed_wing:
    return {.cruise_mps = 12, .climb_mps = 2, .descent_mps = 2, .landing_s = 60};
  case flight::vehicle_class::rover:
    return {.cruise_mps = 2, .climb_mps = 1, .descent_mps = 1, .landing_s = 0};
  case flight::vehicle_class::multirotor:
  case flight::vehicle_class::unknown:
    break;
  }
  return {};
}

std::optional<double> seconds_for(const way& what, const pace& how_fast) {
  if (!is_sound(what.horizontal_m) || !is_sound(what.climb_m) || !is_sound(what.descent_m) || !is_sound(what.wait_s))
    return std::nullopt;
  const auto result = what.horizontal_m / how_fast.cruise_mps + what.climb_m / how_fast.climb_mps +
                      what.descent_m / how_fast.descent_mps + what.wait_s + (what.is_landing ? how_fast.landing_s : 0);
  return is_sound(result) ? std::optional(result) : std::nullopt;
}

way straight_home(double distance_m, double height_m, double return_height_m) {
  const auto up_m = std::max(0.0, height_m); // a vehicle below its home climbs, and comes down less
  const auto highest_m = std::max(up_m, return_height_m);
  return {distance_m, highest_m - std::min(height_m, highest_m), highest_m, true};
}

void drain_meter::on_sample(int percent, std::int64_t now_ns) {
  if (!is_known(percent))
    return;
  const auto newest = lows_.empty() ? first_ : std::optional(lows_.back());
  if (!newest || std::abs(percent - newest->percent) > max_jump_points) {
    lows_.clear();
    first_ = {percent, now_ns};
    return;
  }
  if (percent >= newest->percent)
    return;
  lows_.push_back({percent, now_ns});
  if (lows_.size() > max_lows)
    lows_.pop_front();
}

std::optional<double> drain_meter::percent_per_s() const {
  if (lows_.size() < min_lows || lows_.back().at_ns - lows_.front().at_ns < min_measured_ns)
    return std::nullopt;
  const auto result = (lows_.front().percent - lows_.back().percent) * ns_per_s /
                      static_cast<double>(lows_.back().at_ns - lows_.front().at_ns);
  return std::min(result, max_percent_per_s);
}

std::optional<double> spare_percent(int percent, int reserve_percent, const std::optional<double>& drain,
                                    const std::optional<double>& seconds) {
  if (!is_known(percent) || !drain || !seconds || !is_sound(*drain) || !is_sound(*seconds))
    return std::nullopt;
  const auto result = percent - reserve_percent - *drain * *seconds;
  return std::isfinite(result) ? std::optional(result) : std::nullopt;
}

bool shortage_watch::becomes_short(const std::optional<double>& spare_percent) {
  if (!spare_percent)
    return false;
  const bool was_short = is_short_;
  is_short_ = *spare_percent <= 0 || (was_short && *spare_percent < enough_percent);
  return is_short_ && !was_short;
}

} // namespace godwit::energy
