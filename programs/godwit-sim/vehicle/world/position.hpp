// Places on the WGS84 ellipsoid, and the way between them.
//
// Exact, and a microsecond or two each; the small steps of a moving vehicle use world/nearby.hpp. Latitudes are -90 to
// 90. Thread: pure. Source: GeographicLib (geodesics after Karney, 2013).
#pragma once

namespace godwit::sim {

struct position {
  double latitude_deg = 0;
  double longitude_deg = 0;
  double altitude_m = 0; // above mean sea level, which the simulation takes for the ellipsoid
  bool operator==(const position&) const = default;
};

struct course {
  double bearing_deg = 0; // 0 to 360, from true north
  double distance_m = 0;  // along the ground
};

// Of no distance: bearing 0.
[[nodiscard]] course between(const position& from, const position& to);
// The altitude stays.
[[nodiscard]] position moved(const position& from, const course& by);

} // namespace godwit::sim
