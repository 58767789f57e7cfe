// Straight lines in the flat picture of a local projection: metres to the east and to the north. Thread: pure.
#pragma once

#include <vector>

#include "actors/domain/geo/local_projection.hpp"

namespace godwit::geo {

// What is nearer than this to a side of an area lies on it: a millimetre is less than any position is known to.
inline constexpr double edge_width_m = 0.001;

// Two points: a side of a polygon, or a leg. They may be the same point.
struct segment {
  local_point from;
  local_point to;
};

[[nodiscard]] local_point operator+(const local_point& a, const local_point& b);
[[nodiscard]] local_point operator-(const local_point& a, const local_point& b);
[[nodiscard]] local_point operator*(double factor, const local_point& a);
[[nodiscard]] double dot(const local_point& a, const local_point& b);
// Above 0 when B points to the left of A.
[[nodiscard]] double cross(const local_point& a, const local_point& b);
[[nodiscard]] double length_m(const local_point& a);

// SHARE 0 is where the segment begins, 1 where it ends.
[[nodiscard]] local_point at_share(const segment& s, double share);

[[nodiscard]] double distance_m(const local_point& at, const segment& s);
// 0 when they cross or touch.
[[nodiscard]] double distance_m(const segment& a, const segment& b);

// Appends the shares of S, between 0 and 1, at which a point that moves along it can come to or leave: the side itself,
// and what lies nearer than MARGIN to it. Some of the shares may mean nothing.
void add_turning_shares(const segment& s, const segment& side, double margin_m, std::vector<double>& shares);

} // namespace godwit::geo
