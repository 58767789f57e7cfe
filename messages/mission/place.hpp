// Places on earth as the documents of a mission write them: degrees (WGS 84), and metres above the place of take-off.
// Thread: plain values.
#pragma once

#include "io/fields/field_table.hpp"

namespace godwit::mission {

// A corner of a polygon.
struct vertex {
  double latitude = 0;  // degrees, -90 to 90
  double longitude = 0; // degrees, -180 to 180

  static constexpr auto fields =
      io::table("mission.vertex", io::field("latitude", &vertex::latitude), io::field("longitude", &vertex::longitude));
  friend bool operator==(const vertex&, const vertex&) = default;
};

struct position {
  double latitude = 0;
  double longitude = 0;
  double altitude_m = 0;

  static constexpr auto fields =
      io::table("mission.position", io::field("latitude", &position::latitude),
                io::field("longitude", &position::longitude), io::field("altitude_m", &position::altitude_m));
  friend bool operator==(const position&, const position&) = default;
};

} // namespace godwit::mission
