// Boxes of latitude and longitude, as a spatial index asks for them.
//
// A box never crosses the antimeridian: what does becomes two boxes. What reaches a pole goes all around it.
// Thread: pure.
#pragma once

#include <vector>

#include "actors/domain/geo/point.hpp"

namespace godwit::geo {

struct bounding_box {
  double south_deg = 0;
  double north_deg = 0;
  double west_deg = 0; // not above east
  double east_deg = 0;

  [[nodiscard]] bool contains(const point& at) const {
    return at.latitude_deg >= south_deg && at.latitude_deg <= north_deg && at.longitude_deg >= west_deg &&
           at.longitude_deg <= east_deg;
  }
};

// One or two boxes with everything that lies within RADIUS of CENTRE, whichever sign the meridian of 180 is written
// with; less than 1 % and 2 mm more. Any radius from 0 on.
[[nodiscard]] std::vector<bounding_box> boxes_around(const point& centre, double radius_m);

} // namespace godwit::geo
