// Where an autopilot returns to, and from where it counts altitudes. Degrees (WGS 84), metres above mean sea level.
// Thread: plain values. Source: HOME_POSITION (242).
#pragma once

#include "io/fields/field_table.hpp"

namespace godwit::flight {

struct home_place {
  double latitude = 0;
  double longitude = 0;
  double above_sea_m = 0;

  GODWIT_FIELDS(home_place, "flight.home_place", latitude, longitude, above_sea_m);
  friend bool operator==(const home_place&, const home_place&) = default;
};

} // namespace godwit::flight
