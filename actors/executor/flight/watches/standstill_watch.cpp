#include "actors/executor/flight/watches/standstill_watch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "actors/domain/geo/geodesic.hpp"
#include "actors/executor/plan/places.hpp"
#include "io/mavlink/enums.hpp"

namespace godwit::executor {
namespace {

using io::mavlink::mav_cmd;

constexpr double ns_per_s = 1e9;
constexpr double longest_wait_s = 86'400; // a day

// How long the vehicle stays in its place for ITEM; infinite: until somebody says otherwise.
double wait_of(const io::mavlink::mission_item_int& item) {
  switch (static_cast<mav_cmd>(item.command)) {
  case mav_cmd::nav_waypoint:
  case mav_cmd::nav_spline_waypoint:
  case mav_cmd::nav_loiter_time:
  case mav_cmd::condition_delay:
    return item.param1;
  case mav_cmd::nav_delay: // below 0: until a time of day
    return item.param1 < 0 ? std::numeric_limits<double>::infinity() : item.param1;
  case mav_cmd::nav_loiter_unlim:
  case mav_cmd::nav_guided_enable:
    return std::numeric_limits<double>::infinity();
  default:
    return 0;
  }
}

double apart_m(const mission::position& a, const mission::position& b) {
  return std::hypot(geo::distance_m(plan::point_of(a), plan::point_of(b)), a.altitude_m - b.altitude_m);
}

} // namespace

std::optional<mission::position> standstill_watch::place_to_leave(instant now) const {
  const auto& view = flight_.view;
  if (!flight_.is_in_flight() || flight_.s.status.now != phase::flying || flight_.has_person() || !view.is_armed() ||
      !view.is_in(flight::mode_kind::mission) || !view.current())
    return std::nullopt;
  return view.place(now.now_ns);
}

// The items in front of it as well: a delay holds the vehicle while a later item is the current one.
std::int64_t standstill_watch::may_wait_ns(std::uint16_t sequence) const {
  double longest_s = 0;
  if (flight_.s.flown)
    for (const auto& each : flight_.s.flown->items)
      if (each.seq <= sequence && each.seq + 2 >= sequence && !std::isnan(wait_of(each)))
        longest_s = std::max(longest_s, wait_of(each));
  if (longest_s > longest_wait_s)
    return std::numeric_limits<std::int64_t>::max();
  return patience_ns + static_cast<std::int64_t>(longest_s * ns_per_s);
}

void standstill_watch::look(effects& out, instant now) {
  const auto at = place_to_leave(now);
  if (!at) {
    standing_.reset();
    return;
  }
  const auto sequence = flight_.view.current()->seq;
  if (!standing_ || standing_->sequence != sequence || apart_m(standing_->at, *at) > stands_within_m) {
    standing_ = standing{*at, now.now_ns, sequence};
    return;
  }
  if (standing_->is_told || now.now_ns - standing_->since_ns < may_wait_ns(sequence))
    return;
  standing_->is_told = true;
  out.emplace_back(announce{"the vehicle is armed and in its mission mode, and has not moved for " +
                                std::to_string((now.now_ns - standing_->since_ns) / 1'000'000'000) +
                                " s: keep away from it; call it home, or disarm it",
                            true});
}

} // namespace godwit::executor
