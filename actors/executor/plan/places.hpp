// The places of missions, of plans and of vehicles, as points. Degrees (WGS 84). Thread: pure.
#pragma once

#include "actors/domain/geo/point.hpp"

namespace godwit::executor::plan {

// AT has a latitude and a longitude: a position or a corner of a mission, the vehicle's home.
template <class Place>
[[nodiscard]] geo::point point_of(const Place& at) {
  return {at.latitude, at.longitude};
}

} // namespace godwit::executor::plan
