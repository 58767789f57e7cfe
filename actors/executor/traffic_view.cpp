#include "actors/executor/traffic_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

#include "actors/domain/geo/distance_text.hpp"
#include "actors/domain/geo/geodesic.hpp"
#include "actors/executor/plan/places.hpp"
#include "actors/executor/preflight/result.hpp"
#include "actors/executor/view.hpp"
#include "io/mavlink/frame_meaning.hpp"

namespace godwit::executor {
namespace {

constexpr double m_of_mm = 1e-3;
constexpr double m_of_cm = 1e-2;
constexpr double s_of_ns = 1e-9;
constexpr double rad_of_deg = std::numbers::pi / 180;

// By the number of MAV_COLLISION_ACTION.
std::string_view words_of_action(std::uint8_t action) {
  static constexpr std::array<std::string_view, 7> words{"does nothing",   "only reports it",      "climbs or descends",
                                                         "moves sideways", "moves out of its way", "returns",
                                                         "hovers"};
  return action < words.size() ? words.at(action) : "does something that is not known here";
}

std::string collision_sentence(const std::string& name, const io::mavlink::collision& m) {
  const auto in_s = static_cast<double>(m.time_to_minimum_delta);
  const auto apart_m = std::abs(static_cast<double>(m.horizontal_minimum_delta));
  auto result = "the autopilot warns of a collision with " + name;
  if (std::isfinite(in_s) && std::abs(in_s) <= traffic::max_ahead_s && std::isfinite(apart_m))
    result += ", closest in " + std::to_string(std::lround(in_s)) + " s at " + geo::distance_text(apart_m);
  return result + ", and " + std::string(words_of_action(m.action));
}

} // namespace

void traffic_view::take(const io::mavlink::global_position_int& m, std::int64_t now_ns) {
  traffic::own_motion now{{m.lat / io::mavlink::units_a_degree, m.lon / io::mavlink::units_a_degree},
                          m.alt * m_of_mm,
                          m.vx * m_of_cm,
                          m.vy * m_of_cm,
                          -m.vz * m_of_cm};
  own_.reset();
  if (geo::is_valid(now.at))
    own_ = now;
  above_home_m_ = m.relative_alt * m_of_mm;
  own_ns_ = now_ns;
}

void traffic_view::take(const io::mavlink::adsb_vehicle& m, std::int64_t now_ns) {
  sky_.take(m, own_ ? std::optional(own_->at) : std::nullopt, now_ns);
}

// One without a threat ends it.
void traffic_view::take(const io::mavlink::collision& m, std::int64_t now_ns) {
  std::erase_if(warnings_, [&](const warning& each) {
    return (each.source == m.src && each.id == m.id) || now_ns - each.heard_ns >= warning_counts_ns;
  });
  if (m.threat_level == 0)
    return;
  if (warnings_.size() == max_warnings)
    warnings_.erase(warnings_.begin());
  auto name = name_of(m.src, m.id);
  auto sentence = collision_sentence(name, m);
  warnings_.push_back({m.src, m.id, std::move(name), std::move(sentence), now_ns});
}

std::string traffic_view::name_of(std::uint8_t source, std::uint32_t id) const {
  if (source != io::mavlink::collision_source_adsb)
    return "vehicle " + std::to_string(id);
  const auto known = std::ranges::find(sky_.all(), id, &traffic::aircraft::icao);
  return known == sky_.all().end() ? traffic::address_text(id) : known->name;
}

std::optional<traffic::own_motion> traffic_view::own(std::int64_t now_ns) const {
  return now_ns - own_ns_ <= position_counts_ns ? own_ : std::nullopt;
}

std::vector<traffic_view::warning> traffic_view::warnings(std::int64_t now_ns) const {
  auto result = warnings_;
  std::erase_if(result, [&](const warning& each) { return now_ns - each.heard_ns >= warning_counts_ns; });
  return result;
}

// The nearest first.
std::vector<traffic_view::seen> traffic_view::seen_from(const std::optional<traffic::own_motion>& from,
                                                        const traffic::limits& set, std::int64_t now_ns) const {
  std::vector<seen> result;
  for (const auto& each : sky_.all())
    if (now_ns - each.seen_ns < traffic::sky::forgotten_after_ns)
      result.push_back({&each, from ? std::optional(traffic::approach_of(*from, each, set, now_ns)) : std::nullopt});
  std::ranges::stable_sort(result, {}, [](const seen& each) { return each.how ? each.how->distance_m : 0; });
  return result;
}

heard_traffic traffic_view::all(const traffic::limits& set, std::int64_t now_ns) const {
  heard_traffic result;
  for (const auto& [other, how] : seen_from(own(now_ns), set, now_ns)) {
    const auto at = traffic::place_of(*other, now_ns);
    auto& shown = result.aircraft.emplace_back();
    shown.icao = other->icao;
    shown.name = other->name;
    shown.latitude_deg = at.latitude_deg;
    shown.longitude_deg = at.longitude_deg;
    shown.age_s = static_cast<double>(now_ns - other->seen_ns) * s_of_ns;
    shown.altitude_m = other->altitude_m;
    if (other->altitude_m)
      shown.altitude_by = io::name_of(other->altitude_by);
    shown.course_deg = other->course_deg;
    shown.speed_mps = other->speed_mps;
    shown.climb_mps = other->climb_mps;
    shown.sentence = how ? traffic::sentence_about(other->name, *how) : other->name + ", distance not known";
    if (!how)
      continue;
    shown.distance_m = how->distance_m;
    shown.height_m = how->height_m;
    shown.is_close = how->is_close;
    if (how->point) {
      shown.closest_in_s = how->point->in_s;
      shown.closest_m = how->point->distance_m;
    }
  }
  for (const auto& each : warnings(now_ns))
    result.warnings.push_back(each.sentence);
  result.without_place = sky_.without_place();
  result.without_room = sky_.without_room();
  return result;
}

std::string traffic_view::on_way(const mission::position& to, double cruise_mps, traffic::limits set,
                                 std::int64_t now_ns) const {
  auto way = own(now_ns);
  if (!way)
    return {};
  const auto there = plan::point_of(to);
  const auto distance_m = geo::distance_m(way->at, there);
  const auto bearing = geo::bearing_deg(way->at, there) * rad_of_deg;
  set.time_s = std::clamp(distance_m / cruise_mps, 1.0, traffic::max_ahead_s);
  way->north_mps = std::min(cruise_mps, distance_m) * std::cos(bearing);
  way->east_mps = std::min(cruise_mps, distance_m) * std::sin(bearing);
  way->climb_mps = (to.altitude_m - above_home_m_) / set.time_s;
  std::vector<std::string> close;
  for (const auto& [other, how] : seen_from(way, set, now_ns))
    if (how->is_close)
      close.push_back(traffic::sentence_about(other->name, *how));
  return close.empty() ? std::string() : "other aircraft near the way there: " + preflight::summary_of(close);
}

} // namespace godwit::executor
