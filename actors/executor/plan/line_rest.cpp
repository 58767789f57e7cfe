#include "actors/executor/plan/line_rest.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "actors/domain/geo/geodesic.hpp"
#include "actors/executor/plan/places.hpp"

namespace godwit::executor::plan {

namespace {

constexpr double max_beside_m = 10; // wind and GPS; lines lie farther apart, or were flown the other way
constexpr double min_along_m = 1;

} // namespace

std::optional<double> way_along(const geo::point& from, const geo::point& to, const geo::point& at) {
  const double angle = (geo::bearing_deg(from, at) - geo::bearing_deg(from, to)) * std::numbers::pi / 180;
  const double distance_m = geo::distance_m(from, at);
  const double along_m = distance_m * std::cos(angle);
  if (along_m < min_along_m || std::abs(distance_m * std::sin(angle)) > max_beside_m)
    return std::nullopt;
  return std::min(along_m, geo::distance_m(from, to));
}

mission::position place_along(const mission::position& from, const mission::position& to, double along_m) {
  const auto at = geo::destination(point_of(from), geo::bearing_deg(point_of(from), point_of(to)), along_m);
  const double share = along_m / std::max(along_m, geo::distance_m(point_of(from), point_of(to)));
  return {at.latitude_deg, at.longitude_deg, std::lerp(from.altitude_m, to.altitude_m, share)};
}

} // namespace godwit::executor::plan
