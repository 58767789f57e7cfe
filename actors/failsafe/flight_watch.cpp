#include "actors/failsafe/flight_watch.hpp"

#include <cmath>

#include "actors/failsafe/events.hpp"

namespace godwit::failsafe {

void flight_watch::on_heartbeat(vehicle_class what, bool armed, std::int64_t now_ns) {
  what_ = what;
  armed_ = armed;
  if (!armed)
    ended_armed_ns_.reset();
  heartbeat_ns_ = now_ns;
}

void flight_watch::on_speed(double mps) {
  if (std::isfinite(mps))
    speed_mps_ = mps;
}

bool flight_watch::is_in_the_air() const {
  if (!armed_)
    return false;
  if (what_ == vehicle_class::rover)
    return speed_mps_ >= moving_mps_;
  return landed_ == landed_state::in_air || landed_ == landed_state::taking_off || landed_ == landed_state::landing;
}

bool flight_watch::is_down(std::int64_t now_ns) {
  if (what_ == vehicle_class::rover || landed_ != landed_state::on_ground) {
    ground_since_ns_.reset();
    return !armed_;
  }
  if (!ground_since_ns_)
    ground_since_ns_ = now_ns;
  return !armed_ || now_ns - *ground_since_ns_ >= ground_settle_ms * ns_per_ms;
}

flight_now flight_watch::evaluate(std::int64_t now_ns) {
  if (!heartbeat_ns_ || now_ns - *heartbeat_ns_ >= vehicle_lost_ms * ns_per_ms)
    return {.in_flight = in_flight_};
  const bool in_the_air = is_in_the_air();
  const bool down = is_down(now_ns);
  const bool before = in_flight_;
  in_flight_ = in_the_air || (before && !down);
  flight_now result{.link_up = true, .in_flight = in_flight_, .may_act = in_the_air};
  result.near_ground = landed_ == landed_state::taking_off || landed_ == landed_state::landing;
  result.begins = in_flight_ && !before;
  result.is_found = result.begins && !was_down_;
  result.is_bounce = result.begins && ended_armed_ns_ && now_ns - *ended_armed_ns_ <= bounces_within_ms * ns_per_ms;
  result.ends = before && !in_flight_;
  if (result.ends && armed_)
    ended_armed_ns_ = now_ns;
  result.landed_known = what_ == vehicle_class::rover || landed_ != landed_state::unknown;
  was_down_ = was_down_ || !armed_ || landed_ == landed_state::on_ground;
  return result;
}

} // namespace godwit::failsafe
