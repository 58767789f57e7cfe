#include "actors/failsafe/battery_filter.hpp"

#include <algorithm>
#include <cstdlib>

#include "actors/failsafe/events.hpp"

namespace godwit::failsafe {

void battery_filter::run::take(const sample& one) {
  if (one.percent > threshold) {
    end();
    return;
  }
  if (!since_ns)
    since_ns = one.at_ns;
  samples = std::min(samples + 1, battery_settle_samples);
}

void battery_filter::run::end() {
  since_ns.reset();
  samples = 0;
}

bool battery_filter::run::holds(std::int64_t now_ns) const {
  return since_ns && samples >= battery_settle_samples && now_ns - *since_ns >= battery_settle_ms * ns_per_ms;
}

// Against a sample that is older than a second, as many points more are believable as it is older.
bool battery_filter::jumps(const sample& one) const {
  return std::any_of(recent_.begin(), recent_.end(), [&](const sample& before) {
    const auto apart_ns = std::max(one.at_ns - before.at_ns, ns_per_s);
    return std::abs(one.percent - before.percent) * ns_per_s > battery_jump_points * apart_ns;
  });
}

void battery_filter::forget_before(std::int64_t at_ns) {
  while (recent_.size() > 1 && recent_.front().at_ns < at_ns)
    recent_.pop_front();
}

void battery_filter::remember(const sample& one) {
  if (recent_.size() == max_battery_samples)
    recent_.pop_front();
  recent_.push_back(one);
}

void battery_filter::distrust() {
  known_ = false;
  critical_.end();
  low_.end();
}

void battery_filter::on_sample(int percent, std::int64_t now_ns) {
  if (last_ns_ && now_ns - *last_ns_ > battery_stale_ms * ns_per_ms)
    distrust();
  last_ns_ = now_ns;
  if (percent < 0 || percent > 100) {
    distrust();
    return;
  }
  const sample one{percent, now_ns};
  forget_before(now_ns - ns_per_s);
  if (jumps(one)) {
    distrust();
  } else {
    known_ = true;
    critical_.take(one);
    low_.take(one);
  }
  remember(one);
}

battery_verdict battery_filter::judge(std::int64_t now_ns) const {
  if (!known_ || now_ns - *last_ns_ > battery_stale_ms * ns_per_ms)
    return {};
  return {true, recent_.back().percent, critical_.holds(now_ns), low_.holds(now_ns)};
}

} // namespace godwit::failsafe
