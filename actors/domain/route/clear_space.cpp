#include "actors/domain/route/clear_space.hpp"

#include <algorithm>

#include "actors/domain/geofence/coverage.hpp"
#include "actors/domain/geofence/fence.hpp"

namespace godwit::route {

clear_space::clear_space(std::span<const mission::geofence> fences, const geo::local_projection& projection,
                         const altitude_band& altitudes, double margin_m)
    : margin_m_(margin_m) {
  for (std::size_t i = 0; i < fences.size(); ++i) {
    const auto& fence = fences[i];
    const bool is_inclusion = fence.kind == mission::fence_kind::inclusion;
    const auto band = geofence::altitudes_of(fence);
    has_inclusions_ = has_inclusions_ || is_inclusion;
    if (is_inclusion ? band.has_all_of(altitudes) : band.meets(altitudes))
      (is_inclusion ? inclusions_ : exclusions_)
          .push_back({i, geo::flat_polygon(geofence::corners_of(fence), projection)});
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
  std::vector<geofence::way_over> areas;
  areas.reserve(inclusions_.size());
  for (const auto& each : inclusions_)
    areas.push_back({&each.area, way, {}});
  return !geofence::leaves_at(areas, margin_m);
}

bool clear_space::is_clear(const segment& way) const {
  const auto blocks = [&](const flat_fence& each) {
    return each.area.has_sides_within(margin_m_, way) || each.area.contains(way.from);
  };
  return std::none_of(exclusions_.begin(), exclusions_.end(), blocks) && is_included(way, margin_m_);
}

bool clear_space::is_clear_from_here(const segment& way) const {
  const auto blocks = [&](const flat_fence& each) {
    const double allowed_m = std::min(margin_m_, each.area.distance_to_sides_m(way.from) - geo::edge_width_m);
    return each.area.has_sides_within(std::max(allowed_m, geo::edge_width_m), way) || each.area.contains(way.from);
  };
  if (std::any_of(exclusions_.begin(), exclusions_.end(), blocks))
    return false;
  double inside_m = 0;
  for (const auto& each : inclusions_)
    if (each.area.contains(way.from))
      inside_m = std::max(inside_m, each.area.distance_to_sides_m(way.from));
  return is_included(way, std::clamp(inside_m - geo::edge_width_m, 0.0, margin_m_));
}

} // namespace godwit::route
