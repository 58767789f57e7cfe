// Where a vehicle is: on the ground, and metres above the place of take-off. Thread: plain value.
#pragma once

#include "actors/domain/geo/point.hpp"

namespace godwit::geofence {

struct place {
  geo::point at;
  double altitude_m = 0;
};

} // namespace godwit::geofence
