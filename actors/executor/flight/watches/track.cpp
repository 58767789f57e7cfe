#include "actors/executor/flight/watches/track.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "actors/domain/geo/plane.hpp"
#include "io/mavlink/enums.hpp"
#include "io/mavlink/frame_meaning.hpp"

namespace godwit::executor {

namespace {

using io::mavlink::mav_cmd;
using io::mavlink::number;
using io::mavlink::units_a_degree;

constexpr double metres_of_degree = 111'195; // of latitude, on a sphere

// Good to a percent within the tens of kilometres of a mission.
double metres_between(const geo::point& a, const geo::point& b) {
  const double longitude = std::remainder(a.longitude_deg - b.longitude_deg, 360.0);
  const double cosine = std::cos(a.latitude_deg * std::numbers::pi / 180);
  return metres_of_degree * std::hypot(a.latitude_deg - b.latitude_deg, longitude * cosine);
}

// From WHERE to the straight between two positions.
double metres_to_straight(const geo::point& where, const geo::point& from, const geo::point& to) {
  const double cosine = std::cos(where.latitude_deg * std::numbers::pi / 180);
  const auto seen_from_there = [&](const geo::point& each) {
    return geo::local_point{metres_of_degree * cosine * std::remainder(each.longitude_deg - where.longitude_deg, 360.0),
                            metres_of_degree * (each.latitude_deg - where.latitude_deg)};
  };
  return geo::distance_m(geo::local_point{0, 0}, geo::segment{seen_from_there(from), seen_from_there(to)});
}

// The nearest that it can have been on the way between two positions.
double nearest_between(const geo::point& where, const geo::point& from, const geo::point& to, std::int64_t took_ns) {
  const double straight_m = metres_to_straight(where, from, to);
  if (took_ns <= track::max_gap_ns)
    return straight_m;
  const double flown_m = track::fastest_mps * static_cast<double>(took_ns) * 1e-9;
  const double bent_m = (metres_between(where, from) + metres_between(where, to) - flown_m) / 2;
  return std::clamp(bent_m, 0.0, straight_m);
}

bool is_loiter(std::uint16_t command) {
  constexpr std::array loiters{number(mav_cmd::nav_loiter_unlim), number(mav_cmd::nav_loiter_turns),
                               number(mav_cmd::nav_loiter_time)};
  return std::ranges::find(loiters, command) != loiters.end();
}

bool is_place(const io::mavlink::mission_item_int& item) {
  return (item.command == number(mav_cmd::nav_waypoint) || is_loiter(item.command)) && (item.x != 0 || item.y != 0);
}

} // namespace

void track::begin(const std::vector<io::mavlink::mission_item_int>& items, flight::vehicle_class vehicle,
                  double own_loiter_radius_m, std::int64_t now_ns) {
  is_wing_ = vehicle == flight::vehicle_class::fixed_wing;
  places_.clear();
  for (const auto& each : items) {
    if (!is_place(each))
      continue;
    const double radius_m = is_loiter(each.command) && each.param3 != 0 ? std::abs(each.param3) : own_loiter_radius_m;
    const bool circles = is_wing_ || is_loiter(each.command);
    const double accepted_m = each.command == number(mav_cmd::nav_waypoint) ? std::abs(each.param2) : 0;
    places_.push_back({each.seq,
                       {each.x / units_a_degree, each.y / units_a_degree},
                       accepted_m + (circles ? radius_m : 0),
                       std::numeric_limits<double>::infinity()});
  }
  left_ns_ = now_ns;
}

void track::on_position(const geo::point& at, std::int64_t now_ns) {
  if (!last_)
    first_ns_ = now_ns;
  const auto from = last_.value_or(at);
  const auto took_ns = last_ ? now_ns - last_ns_ : 0;
  last_ = at;
  last_ns_ = now_ns;
  for (auto& each : places_)
    each.nearest_m = std::min(each.nearest_m, nearest_between(each.at, from, at, took_ns));
}

std::vector<std::uint16_t> track::never_near(std::uint16_t first, std::uint16_t last,
                                             std::optional<std::uint16_t> reached) const {
  std::vector<std::uint16_t> result;
  if (!last_ || first_ns_ > left_ns_)
    return result;
  for (const auto& each : places_) {
    const double margin = is_wing_ ? wing_margin_m : each.sequence == reached ? margin_m : passed_margin_m;
    if (each.sequence >= first && each.sequence <= last && each.nearest_m > each.arrives_m + margin)
      result.push_back(each.sequence);
  }
  return result;
}

std::optional<double> track::nearest_m(std::uint16_t sequence) const {
  const auto found = std::ranges::find(places_, sequence, &place::sequence);
  if (found == places_.end() || !std::isfinite(found->nearest_m))
    return std::nullopt;
  return found->nearest_m;
}

} // namespace godwit::executor
