#include "actors/domain/geo/plane.hpp"

#include <algorithm>
#include <cmath>

namespace godwit::geo {

namespace {

void add_share(double share, std::vector<double>& shares) {
  if (share > 0 && share < 1)
    shares.push_back(share);
}

// Where S crosses the endless line through FROM along WAY; nowhere when they are parallel.
void add_line_share(const segment& s, const local_point& from, const local_point& way, std::vector<double>& shares) {
  const double slope = cross(s.to - s.from, way);
  if (slope != 0)
    add_share(cross(from - s.from, way) / slope, shares);
}

void add_circle_shares(const segment& s, const local_point& centre, double radius_m, std::vector<double>& shares) {
  const auto way = s.to - s.from;
  const double square = dot(way, way);
  if (square == 0)
    return;
  const double middle = dot(centre - s.from, way) / square;
  const double beside_m = length_m(at_share(s, middle) - centre);
  add_share(middle, shares); // as good as the nearest place, for a circle of no width
  if (beside_m >= radius_m)
    return;
  const double half = std::sqrt((radius_m * radius_m - beside_m * beside_m) / square);
  add_share(middle - half, shares);
  add_share(middle + half, shares);
}

bool cross_each_other(const segment& a, const segment& b) {
  const auto a_way = a.to - a.from;
  const auto b_way = b.to - b.from;
  const bool b_on_both_sides = (cross(a_way, b.from - a.from) > 0) != (cross(a_way, b.to - a.from) > 0);
  const bool a_on_both_sides = (cross(b_way, a.from - b.from) > 0) != (cross(b_way, a.to - b.from) > 0);
  return a_on_both_sides && b_on_both_sides;
}

} // namespace

local_point operator+(const local_point& a, const local_point& b) {
  return {a.east_m + b.east_m, a.north_m + b.north_m};
}

local_point operator-(const local_point& a, const local_point& b) {
  return {a.east_m - b.east_m, a.north_m - b.north_m};
}

local_point operator*(double factor, const local_point& a) { return {factor * a.east_m, factor * a.north_m}; }

double dot(const local_point& a, const local_point& b) { return a.east_m * b.east_m + a.north_m * b.north_m; }

double cross(const local_point& a, const local_point& b) { return a.east_m * b.north_m - a.north_m * b.east_m; }

double length_m(const local_point& a) { return std::hypot(a.east_m, a.north_m); }

local_point at_share(const segment& s, double share) { return s.from + share * (s.to - s.from); }

double distance_m(const local_point& at, const segment& s) {
  const auto way = s.to - s.from;
  const double square = dot(way, way);
  const double share = square > 0 ? std::clamp(dot(at - s.from, way) / square, 0.0, 1.0) : 0;
  return length_m(at - at_share(s, share));
}

double distance_m(const segment& a, const segment& b) {
  if (cross_each_other(a, b))
    return 0;
  return std::min({distance_m(a.from, b), distance_m(a.to, b), distance_m(b.from, a), distance_m(b.to, a)});
}

void add_turning_shares(const segment& s, const segment& side, double margin_m, std::vector<double>& shares) {
  const auto way = side.to - side.from;
  add_line_share(s, side.from, way, shares);
  add_circle_shares(s, side.from, margin_m, shares);
  add_circle_shares(s, side.to, margin_m, shares);
  const double length = length_m(way);
  if (margin_m <= 0 || length == 0)
    return;
  const local_point beside = (margin_m / length) * local_point{-way.north_m, way.east_m};
  add_line_share(s, side.from + beside, way, shares);
  add_line_share(s, side.from - beside, way, shares);
}

} // namespace godwit::geo
