#include "actors/failsafe/fence_watch.hpp"

#include <cmath>

#include "actors/domain/geo/local_projection.hpp"
#include "actors/failsafe/events.hpp"

namespace godwit::failsafe {

namespace {

using geofence::place;

place place_of(const position& reported) {
  return {{reported.latitude_deg, reported.longitude_deg}, reported.altitude_m};
}

// An autopilot without a fix reports 0, 0. Nobody flies there.
bool is_place(const position& reported) {
  return geo::is_valid({reported.latitude_deg, reported.longitude_deg}) && std::isfinite(reported.altitude_m) &&
         (reported.latitude_deg != 0 || reported.longitude_deg != 0);
}

} // namespace

void fence_watch::on_position(const position& reported, std::int64_t now_ns) {
  if (!is_place(reported))
    return; // the last good one gets old, and then there is no verdict
  newest_ = reported;
  newest_ns_ = now_ns;
  if (waiting_.size() == max_waiting_positions)
    waiting_.erase(waiting_.begin() + 1);
  waiting_.push_back({place_of(reported), now_ns, reported.boot_ms});
}

place fence_watch::predicted() const {
  const auto here = place_of(newest_);
  if (!std::isfinite(newest_.north_mps) || !std::isfinite(newest_.east_mps) || !std::isfinite(newest_.down_mps))
    return here;
  const geo::local_projection around(here.at);
  return {around.to_globe({newest_.east_mps * look_ahead_s, newest_.north_mps * look_ahead_s}),
          here.altitude_m - newest_.down_mps * look_ahead_s};
}

void fence_watch::set(geofence::fence_set fences) {
  fences_ = std::move(fences);
  accused_.reset();
  is_outside_ = false;
}

void fence_watch::forget_way() {
  waiting_.clear();
  judged_.reset();
}

bool fence_watch::is_confirmed_by(const fix& next) const {
  return accused_ && next.boot_ms != accused_->boot_ms &&
         next.at_ns - accused_->at_ns <= confirmed_within_ms * ns_per_ms;
}

// The ways between all positions since the last tick. Over a gap no way is drawn: nobody knows where it went.
std::optional<breach> fence_watch::judge_waiting(bool floor_counts) {
  std::optional<breach> found;
  for (const auto& each : waiting_) {
    const auto gap_ms = accused_ ? confirmed_within_ms : position_stale_ms;
    const auto outside = judged_ && each.at_ns - judged_->at_ns <= gap_ms * ns_per_ms
                             ? fences_.breach_on(judged_->there, each.there, floor_counts)
                             : fences_.breach_at(each.there, floor_counts);
    const bool is_repeated = is_outside_ && accused_ && each.boot_ms == accused_->boot_ms;
    is_outside_ = outside && (is_repeated || is_confirmed_by(each));
    if (is_outside_ && !found)
      found = outside;
    if (is_outside_ || !outside)
      judged_ = each;
    // The same position again is no second one; of another time it is the one that the next is held against.
    if (!outside)
      accused_.reset();
    else if (!accused_ || each.boot_ms != accused_->boot_ms)
      accused_ = each;
  }
  waiting_.clear();
  return found;
}

fence_verdict fence_watch::evaluate(std::int64_t now_ns, bool near_ground) {
  if (fences_.size() == 0) {
    forget_way();
    return {};
  }
  if (!newest_ns_ || now_ns - *newest_ns_ > position_stale_ms * ns_per_ms) {
    forget_way();
    return {.finding = fence_finding::no_verdict, .found = {}, .ahead = {}};
  }
  const auto here = place_of(newest_);
  const bool floor_counts = floor_reached_ && !near_ground;
  auto found = judge_waiting(floor_counts);
  if (!found && is_outside_)
    found = fences_.breach_at(here, floor_counts); // it is still there
  if (found)
    return {.finding = fence_finding::breached, .found = found, .ahead = {}};
  floor_reached_ = floor_reached_ || !fences_.breach_at(here, true);
  return {.finding = fence_finding::inside, .found = {}, .ahead = fences_.breach_on(here, predicted(), floor_counts)};
}

} // namespace godwit::failsafe
