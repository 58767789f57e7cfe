// Fences and places for tests: metres to the east and north of one place, drawn on the globe. Thread: pure.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "actors/domain/geo/local_projection.hpp"
#include "actors/domain/geofence/place.hpp"
#include "messages/mission/document.hpp"

namespace godwit::tests {

using metres = std::pair<double, double>; // east, north

inline constexpr geo::point home{47.397742, 8.545594};
inline constexpr geo::point near_antimeridian{-17.0, 179.9995};

inline geofence::place place_at(double east_m, double north_m, double altitude_m = 50, geo::point origin = home) {
  return {geo::local_projection(origin).to_globe({east_m, north_m}), altitude_m};
}

inline mission::geofence fence_of(mission::fence_kind kind, const std::vector<metres>& corners,
                                  std::optional<double> floor_m = {}, std::optional<double> ceiling_m = {},
                                  geo::point origin = home) {
  mission::geofence result{kind, {}, floor_m, ceiling_m};
  for (const auto& [east_m, north_m] : corners) {
    const auto there = place_at(east_m, north_m, 0, origin).at;
    result.vertices.push_back({there.latitude_deg, there.longitude_deg});
  }
  return result;
}

// From (-HALF, -HALF) to (HALF, HALF) around a place.
inline std::vector<metres> square(double half_m, double east_m = 0, double north_m = 0) {
  return {{east_m - half_m, north_m - half_m},
          {east_m + half_m, north_m - half_m},
          {east_m + half_m, north_m + half_m},
          {east_m - half_m, north_m + half_m}};
}

} // namespace godwit::tests
