#include "actors/domain/route/corner_points.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace godwit::route {

namespace {

constexpr double widest_part_rad = std::numbers::pi / 4;
constexpr double same_angle = 1e-6; // of a part: rounding makes no further one

// Points lie that much farther out than the margin, so that rounding can not bring them or the ways between them in.
constexpr double slack_m = 0.02;

local_point unit(const local_point& way) {
  const double length = length_m(way);
  return length > 0 ? (1 / length) * way : local_point{};
}

local_point to_the_right(const local_point& way) { return {way.north_m, -way.east_m}; }

local_point turned(const local_point& way, double angle_rad) {
  const double cosine = std::cos(angle_rad);
  const double sine = std::sin(angle_rad);
  return {way.east_m * cosine - way.north_m * sine, way.east_m * sine + way.north_m * cosine};
}

// Around one corner of an obstacle that lies to the left of both ways.
void add_arc(const local_point& before, const local_point& corner, const local_point& after, double margin_m,
             std::vector<local_point>& points) {
  const auto way_in = unit(corner - before);
  const auto way_out = unit(after - corner);
  const double turn_rad = std::atan2(cross(way_in, way_out), dot(way_in, way_out));
  if (turn_rad <= 0)
    return;
  const double parts = std::max(1.0, std::ceil(turn_rad / widest_part_rad - same_angle));
  const double part_rad = turn_rad / parts;
  const double out_m = (margin_m + slack_m) / std::cos(part_rad / 2);
  for (double i = 0; i < parts; ++i)
    points.push_back(corner + out_m * turned(to_the_right(way_in), (i + 0.5) * part_rad));
}

void add_corners(const geo::flat_polygon& area, double margin_m, std::vector<local_point>& points) {
  const auto corners = area.corners();
  const auto count = corners.size();
  for (std::size_t i = 0; i < count; ++i)
    add_arc(corners[(i + count - 1) % count], corners[i], corners[(i + 1) % count], margin_m, points);
}

// What lies outside is the obstacle here; it is on the left of who goes around clockwise.
void add_dents(const geo::flat_polygon& area, double margin_m, std::vector<local_point>& points) {
  const auto corners = area.corners();
  const auto count = corners.size();
  for (std::size_t i = 0; i < count; ++i)
    add_arc(corners[(i + 1) % count], corners[i], corners[(i + count - 1) % count], margin_m, points);
}

// The sides of two areas, each moved inwards by the margin, meet at this corner of what both allow together.
void add_meeting(const segment& a, const segment& b, double margin_m, std::vector<local_point>& points) {
  const auto a_way = unit(a.to - a.from);
  const auto b_way = unit(b.to - b.from);
  const double slope = cross(a_way, b_way);
  if (slope == 0 || distance_m(a, b) > 0)
    return;
  const double in_m = margin_m + slack_m;
  const auto a_from = a.from - in_m * to_the_right(a_way);
  const auto b_from = b.from - in_m * to_the_right(b_way);
  points.push_back(a_from + (cross(b_from - a_from, b_way) / slope) * a_way);
}

void add_meetings(const geo::flat_polygon& a, const geo::flat_polygon& b, double margin_m,
                  std::vector<local_point>& points) {
  for (std::size_t i = 0; i < a.corners().size(); ++i)
    for (std::size_t j = 0; j < b.corners().size(); ++j)
      add_meeting(a.side(i), b.side(j), margin_m, points);
}

} // namespace

std::vector<local_point> corner_points(const clear_space& space) {
  std::vector<local_point> points;
  for (const auto& each : space.exclusions())
    add_corners(each.area, space.margin_m(), points);
  const auto inclusions = space.inclusions();
  for (std::size_t i = 0; i < inclusions.size(); ++i) {
    add_dents(inclusions[i].area, space.margin_m(), points);
    for (std::size_t j = 0; j < i; ++j)
      add_meetings(inclusions[i].area, inclusions[j].area, space.margin_m(), points);
  }
  std::erase_if(points, [&](const local_point& each) { return space.obstruction_at(each).has_value(); });
  return points;
}

} // namespace godwit::route
