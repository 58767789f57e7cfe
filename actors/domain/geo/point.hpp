// A place on the WGS84 ellipsoid, in degrees. Longitudes of -180 and 180 are the same meridian. Thread: plain value.
#pragma once

#include <cmath>

namespace godwit::geo {

struct point {
  double latitude_deg = 0;
  double longitude_deg = 0;
};

// Latitude in -90..90 and longitude in -180..180; false for what is not a number. All of this folder needs valid
// points.
[[nodiscard]] inline bool is_valid(const point& at) {
  return std::abs(at.latitude_deg) <= 90 && std::abs(at.longitude_deg) <= 180;
}

} // namespace godwit::geo
