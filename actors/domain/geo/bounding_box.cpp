#include "actors/domain/geo/bounding_box.hpp"

#include <algorithm>
#include <numbers>

#include "runtime/assert.hpp"

namespace godwit::geo {

namespace {

// The ellipsoid is nowhere curved more tightly than with a radius of 6335 km (along the meridian at the equator). An
// angle taken from a smaller radius is on the safe side everywhere.
constexpr double least_curvature_radius_m = 6'334'000;

// Rounding in degrees and in geodesics stays far below this.
constexpr double box_margin_m = 0.001;

constexpr double degrees = 180 / std::numbers::pi;

// Reaches across the antimeridian are turned into a second box on its other side; touching it is enough, because the
// same meridian may be written with the other sign.
std::vector<bounding_box> split(double south_deg, double north_deg, double west_deg, double east_deg) {
  if (west_deg > -180 && east_deg < 180)
    return {{south_deg, north_deg, west_deg, east_deg}};
  if (east_deg - west_deg >= 360)
    return {{south_deg, north_deg, -180, 180}};
  const double first_west = west_deg <= -180 ? west_deg + 360 : west_deg;
  const double second_east = east_deg >= 180 ? east_deg - 360 : east_deg;
  return {{south_deg, north_deg, first_west, 180}, {south_deg, north_deg, -180, second_east}};
}

} // namespace

std::vector<bounding_box> boxes_around(const point& centre, double radius_m) {
  GODWIT_ASSERT(is_valid(centre) && radius_m >= 0, "geo: a box lies around a place");
  const double angle = (radius_m + box_margin_m) / least_curvature_radius_m;
  const double south_deg = std::max(-90.0, centre.latitude_deg - angle * degrees);
  const double north_deg = std::min(90.0, centre.latitude_deg + angle * degrees);
  if (south_deg <= -90 || north_deg >= 90)
    return {{south_deg, north_deg, -180, 180}};
  // The circle touches its outermost meridians where they are perpendicular to the way from the centre.
  const double reach = std::sin(angle) / std::cos(centre.latitude_deg / degrees);
  const double half_width_deg = reach < 1 ? std::asin(reach) * degrees : 180;
  return split(south_deg, north_deg, centre.longitude_deg - half_width_deg, centre.longitude_deg + half_width_deg);
}

} // namespace godwit::geo
