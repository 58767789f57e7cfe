#include "actors/domain/geofence/fence.hpp"

#include <cmath>
#include <optional>
#include <utility>

namespace godwit::geofence {

namespace {

std::optional<std::string> fault_of(const mission::geofence& each) {
  if (each.vertices.size() < 3)
    return "has " + std::to_string(each.vertices.size()) + " corners; a fence has at least 3";
  if (each.vertices.size() > max_fence_corners)
    return "has " + std::to_string(each.vertices.size()) + " corners; at most " + std::to_string(max_fence_corners) +
           " are possible";
  for (const auto& corner : each.vertices)
    if (!geo::is_valid({corner.latitude, corner.longitude}))
      return "has a corner that is no place on earth";
  for (const auto height_m : {each.floor_m, each.ceiling_m})
    if (height_m && !std::isfinite(*height_m))
      return "has a floor or a ceiling that is not a number";
  if (each.floor_m && each.ceiling_m && *each.floor_m > *each.ceiling_m)
    return "has its floor above its ceiling";
  return std::nullopt;
}

} // namespace

altitude_band altitudes_of(const mission::geofence& fence) {
  return {fence.floor_m.value_or(-endless_m), fence.ceiling_m.value_or(endless_m)};
}

std::vector<geo::point> corners_of(const mission::geofence& fence) {
  std::vector<geo::point> corners;
  corners.reserve(fence.vertices.size());
  for (const auto& each : fence.vertices)
    corners.push_back({each.latitude, each.longitude});
  return corners;
}

tl::expected<fence, std::string> fence::build(const mission::geofence& from) {
  if (auto fault = fault_of(from))
    return tl::unexpected(std::move(*fault));
  return fence(from);
}

fence::fence(const mission::geofence& from)
    : kind_(from.kind), altitudes_(geofence::altitudes_of(from)), area_(corners_of(from)) {}

} // namespace godwit::geofence
