#include "actors/domain/geo/geodesic.hpp"

#include <GeographicLib/Geodesic.hpp>

#include "runtime/assert.hpp"

namespace godwit::geo {

double distance_m(const point& from, const point& to) {
  GODWIT_ASSERT(is_valid(from) && is_valid(to), "geo: a distance has two places on the globe");
  double metres = 0;
  GeographicLib::Geodesic::WGS84().Inverse(from.latitude_deg, from.longitude_deg, to.latitude_deg, to.longitude_deg,
                                           metres);
  return metres;
}

double bearing_deg(const point& from, const point& to) {
  GODWIT_ASSERT(is_valid(from) && is_valid(to), "geo: a bearing has two places on the globe");
  double at_start_deg = 0;
  double at_end_deg = 0;
  GeographicLib::Geodesic::WGS84().Inverse(from.latitude_deg, from.longitude_deg, to.latitude_deg, to.longitude_deg,
                                           at_start_deg, at_end_deg);
  return at_start_deg;
}

point destination(const point& from, double bearing_deg, double distance_m) {
  GODWIT_ASSERT(is_valid(from), "geo: a way begins on the globe");
  point end;
  GeographicLib::Geodesic::WGS84().Direct(from.latitude_deg, from.longitude_deg, bearing_deg, distance_m,
                                          end.latitude_deg, end.longitude_deg);
  return end;
}

} // namespace godwit::geo
