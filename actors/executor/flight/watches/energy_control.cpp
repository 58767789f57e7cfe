#include "actors/executor/flight/watches/energy_control.hpp"

#include <algorithm>
#include <cmath>

#include "actors/domain/geo/geodesic.hpp"
#include "actors/executor/plan/places.hpp"

namespace godwit::executor {
namespace {

constexpr double seconds_per_minute = 60;

// NaN where one of them is no place.
double apart_m(const geo::point& a, const geo::point& b) {
  return geo::is_valid(a) && geo::is_valid(b) ? geo::distance_m(a, b) : std::nan("");
}

energy::way way_of(const plan::flight_plan& plan) {
  energy::way result;
  for (const auto& each : plan.legs) {
    result.horizontal_m += each.times * apart_m(plan::point_of(each.from), plan::point_of(each.to));
    result.climb_m += each.times * std::max(0.0, each.to.altitude_m - each.from.altitude_m);
    result.descent_m += each.times * std::max(0.0, each.from.altitude_m - each.to.altitude_m);
  }
  result.is_landing = plan.ends_on_ground;
  result.wait_s = plan.waits_s;
  return result;
}

} // namespace

effects energy_control::on_battery(instant now) {
  const auto& view = flight_.view;
  const bool is_under_way = flight_.is_in_flight() && view.is_under_way();
  const bool begins = is_under_way && !was_under_way_;
  was_under_way_ = is_under_way;
  if (begins) {
    meter_.begin();
    watch_.begin();
  }
  if (!is_under_way || !view.battery_percent())
    return {};
  meter_.on_sample(*view.battery_percent(), now.now_ns);
  if (const auto newest = meter_.percent_per_s())
    measured_ = newest;
  if (flight_.is_landing() || !watch_.becomes_short(spare(seconds_home(now))))
    return {};
  const auto reserve = std::to_string(flight_.configured.checks.battery_return_percent);
  return {announce{"the battery, at " + std::to_string(*view.battery_percent()) +
                       " %, lasts just for the way home above the " + reserve +
                       " % at which the failsafe returns; end the mission here, or call the vehicle home",
                   true}};
}

std::optional<double> energy_control::drain() const {
  if (measured_)
    return measured_;
  const auto set = flight_.configured.drain_percent_per_min / seconds_per_minute;
  return set > 0 ? std::optional(set) : std::nullopt;
}

std::optional<double> energy_control::spare(const std::optional<double>& seconds) const {
  return energy::spare_percent(flight_.view.battery_percent().value_or(-1),
                               flight_.configured.checks.battery_return_percent, drain(), seconds);
}

std::optional<double> energy_control::seconds_home(instant now) const {
  const auto at = flight_.view.place(now.now_ns);
  const auto& home = flight_.view.home();
  if (!at || !home)
    return std::nullopt;
  const auto distance_m = apart_m(plan::point_of(*at), plan::point_of(*home));
  return energy::seconds_for(energy::straight_home(distance_m, at->altitude_m, flight_.configured.return_altitude_m),
                             energy::pace_of(flight_.view.owner().vehicle));
}

way_home_estimate energy_control::way_home(instant now) const {
  const auto percent = flight_.view.battery_percent().value_or(-1);
  const auto seconds = seconds_home(now);
  const auto rate = drain();
  way_home_estimate result;
  result.reserve_percent = flight_.configured.checks.battery_return_percent;
  if (percent >= 0)
    result.left_percent = percent;
  if (!flight_.view.is_under_way())
    result.why_not_known = "the vehicle is not under way";
  else if (!seconds)
    result.why_not_known = "where the vehicle or its home is, is not known";
  else if (!rate)
    result.why_not_known = "how fast the battery drains is not known yet";
  else {
    result.needs_percent = *rate * *seconds;
    result.spare_percent = spare(seconds);
  }
  return result;
}

std::optional<double> energy_control::spare_after(const plan::flight_plan& plan) const {
  const auto& home = flight_.view.home();
  if (!home)
    return std::nullopt;
  const auto pace = energy::pace_of(flight_.view.owner().vehicle);
  const auto out = energy::seconds_for(way_of(plan), pace);
  const auto distance_m = apart_m(plan::point_of(plan.ends_at), plan::point_of(*home));
  // Down on the ground it is either home, or a person has to see to what comes next.
  const auto back =
      plan.ends_on_ground
          ? std::optional(0.0)
          : energy::seconds_for(
                energy::straight_home(distance_m, plan.ends_at.altitude_m, flight_.configured.return_altitude_m), pace);
  return spare(out && back ? std::optional(*out + *back) : std::nullopt);
}

} // namespace godwit::executor
