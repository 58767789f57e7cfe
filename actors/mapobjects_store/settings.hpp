// What decides how sightings are understood. Thread: plain value.
#pragma once

#include "actors/domain/geo/mgrs.hpp"

namespace godwit::mapobjects_store {

struct settings {
  // A sighting within this distance of a known object of its class group is that object. Positions from the air are
  // good to some ten metres; things of one kind rarely stand closer than this to each other.
  double match_within_m = 30;

  // Below this a difference is the error of the measurement.
  double moved_above_m = 8;

  // What a decline covers: as large as the error of a position.
  geo::cell_size ignored_cell = geo::cell_size::m_10;
};

} // namespace godwit::mapobjects_store
