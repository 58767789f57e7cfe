#include "actors/domain/geo/local_projection.hpp"

#include <GeographicLib/AzimuthalEquidistant.hpp>

#include "runtime/assert.hpp"

namespace godwit::geo {

namespace {

const GeographicLib::AzimuthalEquidistant& projection() {
  static const GeographicLib::AzimuthalEquidistant made(GeographicLib::Geodesic::WGS84());
  return made;
}

} // namespace

local_projection::local_projection(const point& origin) : origin_(origin) {
  GODWIT_ASSERT(is_valid(origin), "geo: a projection has its origin on the globe");
}

local_point local_projection::to_local(const point& at) const {
  GODWIT_ASSERT(is_valid(at), "geo: what is projected lies on the globe");
  local_point result;
  projection().Forward(origin_.latitude_deg, origin_.longitude_deg, at.latitude_deg, at.longitude_deg, result.east_m,
                       result.north_m);
  return result;
}

point local_projection::to_globe(const local_point& at) const {
  point result;
  projection().Reverse(origin_.latitude_deg, origin_.longitude_deg, at.east_m, at.north_m, result.latitude_deg,
                       result.longitude_deg);
  return result;
}

} // namespace godwit::geo
