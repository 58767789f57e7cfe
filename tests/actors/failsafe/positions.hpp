// Positions that a vehicle reports, for tests: metres to the east and north of one place. Thread: pure.
#pragma once

#include "actors/failsafe/events.hpp"
#include "tests/actors/domain/geofence/fences.hpp"

namespace godwit::tests {

inline failsafe::position position_at(double east_m, double north_m, double altitude_m = 50, double east_mps = 0,
                                      double north_mps = 0) {
  const auto there = place_at(east_m, north_m, altitude_m);
  return {there.at.latitude_deg, there.at.longitude_deg, altitude_m, north_mps, east_mps, 0};
}

} // namespace godwit::tests
