// Fences for tests, in metres around one place. Thread: pure.
#pragma once

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "actors/domain/geo/geodesic.hpp"
#include "actors/domain/geo/local_projection.hpp"
#include "messages/mission/document.hpp"

namespace godwit::tests {

inline const geo::point middle{47.4, 8.5};

inline geo::point place(double east_m, double north_m, const geo::point& around = middle) {
  return geo::local_projection(around).to_globe({east_m, north_m});
}

inline mission::vertex corner(double east_m, double north_m, const geo::point& around = middle) {
  const auto at = place(east_m, north_m, around);
  return {at.latitude_deg, at.longitude_deg};
}

inline mission::geofence fence(mission::fence_kind kind, const std::vector<geo::local_point>& corners,
                               const geo::point& around = middle) {
  mission::geofence result{kind, {}, {}, {}};
  for (const auto& each : corners)
    result.vertices.push_back(corner(each.east_m, each.north_m, around));
  return result;
}

inline std::vector<geo::local_point> box(double west_m, double south_m, double east_m, double north_m) {
  return {{west_m, south_m}, {east_m, south_m}, {east_m, north_m}, {west_m, north_m}};
}

inline mission::geofence exclusion(const std::vector<geo::local_point>& corners) {
  return fence(mission::fence_kind::exclusion, corners);
}

inline mission::geofence inclusion(const std::vector<geo::local_point>& corners) {
  return fence(mission::fence_kind::inclusion, corners);
}

// Seen from its middle one corner comes after the other, so that no sides cross; with dents.
inline std::vector<geo::local_point> star(std::mt19937_64& random, const geo::local_point& centre, double least_m,
                                          double most_m) {
  const auto number = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const int count = std::uniform_int_distribution<int>(3, 9)(random);
  std::vector<geo::local_point> corners;
  for (int i = 0; i < count; ++i) {
    const double angle = (i + number(0, 0.6)) * 2 * std::numbers::pi / count;
    const double radius = number(least_m, most_m);
    corners.push_back({centre.east_m + radius * std::cos(angle), centre.north_m + radius * std::sin(angle)});
  }
  return corners;
}

} // namespace godwit::tests
