// Places on earth as the documents of a mission write them: degrees (WGS 84), and metres above the place of take-off.
// Thread: plain values.
#pragma once

#include "io/fields/field_table.hpp"

namespace godwit::mission {

// A corner of a polygon.
struct vertex {
  double latitude = 0;  // degrees, -90 to 90
  double longitude = 0; // degrees, -180 to 180

  GODWIT_FIELDS(vertex, "mission.vertex", latitude, longitude);
  friend bool operator==(const vertex&, const vertex&) = default;
};

struct position {
  double latitude = 0;
  double longitude = 0;
  double altitude_m = 0;

  GODWIT_FIELDS(position, "mission.position", latitude, longitude, altitude_m);
  friend bool operator==(const position&, const position&) = default;
};

} // namespace godwit::mission
