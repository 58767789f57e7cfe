// The shortest way over the ellipsoid: how long it is, and where it leads.
//
// Exact to nanometres everywhere, also across the antimeridian and over the poles; about 1 us a call. Thread: pure.
// Source: C. F. F. Karney, Algorithms for geodesics, 2013 (GeographicLib).
#pragma once

#include "actors/domain/geo/point.hpp"

namespace godwit::geo {

[[nodiscard]] double distance_m(const point& from, const point& to);

// At FROM, clockwise from north: -180 to 180 degrees. Of two equal places: any.
[[nodiscard]] double bearing_deg(const point& from, const point& to);

// The bearing is clockwise from north, at the start.
[[nodiscard]] point destination(const point& from, double bearing_deg, double distance_m);

} // namespace godwit::geo
