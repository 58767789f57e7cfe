#include "actors/ground_port/vehicle_role/current_report.hpp"

#include <algorithm>
#include <limits>

namespace godwit::ground_port::vehicle_role {

namespace {

std::int64_t later(std::int64_t when_ns, std::int64_t period_ns) {
  return period_ns > 0 ? when_ns + period_ns : std::numeric_limits<std::int64_t>::max();
}

} // namespace

std::optional<io::mavlink::mission_current> current_report::due(const io::mavlink::mission_current& now_says,
                                                                std::int64_t now_ns) {
  const bool has_changed = !said_ || (on_change_ && !io::equal(*said_, now_says));
  const bool is_period = said_ && now_ns >= next_period_ns_;
  if (!is_period && (!has_changed || (said_ && now_ns < said_ns_ + min_gap_ns))) {
    next_ns_ = has_changed ? std::min(said_ns_ + min_gap_ns, next_period_ns_) : next_period_ns_;
    return std::nullopt;
  }
  // A turn that comes late does not shift those after it, unless it is late by a whole period.
  const bool is_in_time = is_period && now_ns < later(next_period_ns_, period_ns_);
  next_period_ns_ = later(is_in_time ? next_period_ns_ : now_ns, period_ns_);
  said_ = now_says;
  said_ns_ = now_ns;
  next_ns_ = next_period_ns_;
  return now_says;
}

void current_report::set_period(std::int64_t wanted_ns, std::int64_t now_ns) {
  period_ns_ = wanted_ns;
  next_period_ns_ = said_ ? later(now_ns, period_ns_) : now_ns;
  next_ns_ = next_period_ns_;
}

} // namespace godwit::ground_port::vehicle_role
