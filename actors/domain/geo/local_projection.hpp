// A flat picture of the surroundings of one place: metres to the east and to the north of it.
//
// Azimuthal equidistant: distance and bearing from the origin are exact; at 10 km from it other distances are wrong by
// less than a part in a million. Knows no antimeridian and no poles. About 2 us a call. Thread: pure.
// Source: GeographicLib, AzimuthalEquidistant.
#pragma once

#include "actors/domain/geo/point.hpp"

namespace godwit::geo {

struct local_point {
  double east_m = 0;
  double north_m = 0;
};

class local_projection {
public:
  explicit local_projection(const point& origin);

  [[nodiscard]] local_point to_local(const point& at) const;
  [[nodiscard]] point to_globe(const local_point& at) const;

private:
  point origin_;
};

} // namespace godwit::geo
