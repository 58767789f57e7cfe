#include "actors/domain/route/clear_space.hpp"

#include <algorithm>
#include <limits>

namespace godwit::route {

namespace {

constexpr double endless = std::numeric_limits<double>::infinity();

double floor_of(const mission::geofence& fence) { return fence.floor_m.value_or(-endless); }
double ceiling_of(const mission::geofence& fence) { return fence.ceiling_m.value_or(endless); }

} // namespace

bool meets(const mission::geofence& fence, const altitude_band& altitudes) {
  return floor_of(fence) <= altitudes.highest_m && ceiling_of(fence) >= altitudes.lowest_m;
}

bool has_all_of(const mission::geofence& fence, const altitude_band& altitudes) {
  return floor_of(fence) <= altitudes.lowest_m && ceiling_of(fence) >= altitudes.highest_m;
}

std::optional<double> leaves_at(std::span<const flat_polygon* const> areas, const segment& way, double margin_m) {
  std::vector<double> shares{0, 1};
  for (const auto* area : areas)
    area->add_turning_shares(way, margin_m, shares);
  std::sort(shares.begin(), shares.end());
  const auto is_in = [&](double share) {
    const auto at = at_share(way, share);
    return std::any_of(areas.begin(), areas.end(),
                       [&](const flat_polygon* area) { return area->contains_with_margin(at, margin_m); });
  };
  if (!is_in(0))
    return 0;
  const double shortest = edge_width_m / std::max(edge_width_m, length_m(way.to - way.from));
  for (std::size_t i = 1; i < shares.size(); ++i)
    if (shares[i] - shares[i - 1] > shortest && !is_in((shares[i - 1] + shares[i]) / 2))
      return shares[i - 1];
  return is_in(1) ? std::nullopt : std::optional(1.0);
}

clear_space::clear_space(std::span<const mission::geofence> fences, const geo::local_projection& projection,
                         const altitude_band& altitudes, double margin_m)
    : margin_m_(margin_m) {
  for (std::size_t i = 0; i < fences.size(); ++i) {
    const auto& fence = fences[i];
    const bool is_inclusion = fence.kind == mission::fence_kind::inclusion;
    has_inclusions_ = has_inclusions_ || is_inclusion;
    if (is_inclusion && has_all_of(fence, altitudes))
      inclusions_.push_back({i, flat_polygon(fence.vertices, projection)});
    else if (!is_inclusion && meets(fence, altitudes))
      exclusions_.push_back({i, flat_polygon(fence.vertices, projection)});
  }
}

std::optional<obstruction> clear_space::obstruction_at(const local_point& at) const {
  return obstruction_within(at, margin_m_);
}

std::optional<obstruction> clear_space::obstruction_at_without_margin(const local_point& at) const {
  return obstruction_within(at, 0);
}

std::optional<obstruction> clear_space::obstruction_within(const local_point& at, double margin_m) const {
  std::optional<obstruction> nearest;
  for (const auto& each : exclusions_) {
    const double distance = each.area.contains(at) ? 0 : each.area.distance_to_sides_m(at);
    const bool is_in_the_way = distance <= 0 || distance < margin_m;
    if (is_in_the_way && (!nearest || distance < nearest->distance_m))
      nearest = obstruction{each.index, distance};
  }
  if (nearest || is_included({at, at}, margin_m))
    return nearest;
  double inside_m = 0;
  for (const auto& each : inclusions_)
    if (each.area.contains(at))
      inside_m = std::max(inside_m, each.area.distance_to_sides_m(at));
  return obstruction{std::nullopt, inside_m};
}

bool clear_space::is_included(const segment& way, double margin_m) const {
  if (!has_inclusions_)
    return true;
  std::vector<const flat_polygon*> areas;
  areas.reserve(inclusions_.size());
  for (const auto& each : inclusions_)
    areas.push_back(&each.area);
  return !leaves_at(areas, way, margin_m);
}

bool clear_space::is_clear(const segment& way) const {
  const auto blocks = [&](const flat_fence& each) {
    return each.area.has_sides_within(margin_m_, way) || each.area.contains(way.from);
  };
  return std::none_of(exclusions_.begin(), exclusions_.end(), blocks) && is_included(way, margin_m_);
}

bool clear_space::is_clear_from_here(const segment& way) const {
  const auto blocks = [&](const flat_fence& each) {
    const double allowed_m = std::min(margin_m_, each.area.distance_to_sides_m(way.from) - edge_width_m);
    return each.area.has_sides_within(std::max(allowed_m, edge_width_m), way) || each.area.contains(way.from);
  };
  if (std::any_of(exclusions_.begin(), exclusions_.end(), blocks))
    return false;
  double inside_m = 0;
  for (const auto& each : inclusions_)
    if (each.area.contains(way.from))
      inside_m = std::max(inside_m, each.area.distance_to_sides_m(way.from));
  return is_included(way, std::clamp(inside_m - edge_width_m, 0.0, margin_m_));
}

} // namespace godwit::route
