#include "actors/domain/geo/flat_polygon.hpp"

#include <algorithm>
#include <limits>

#include "runtime/assert.hpp"

namespace godwit::geo {

namespace {

std::vector<local_point> projected(std::span<const point> corners, const local_projection& projection) {
  std::vector<local_point> result;
  result.reserve(corners.size());
  for (const auto& each : corners)
    result.push_back(projection.to_local(each));
  return result;
}

double twice_the_area(std::span<const local_point> corners) {
  double result = 0;
  for (std::size_t i = 0; i < corners.size(); ++i)
    result += cross(corners[i], corners[(i + 1) % corners.size()]);
  return result;
}

// Whether a ray from AT to the east crosses the side. Each side owns its lower end only, so that a corner counts once.
bool crosses_ray(const segment& side, const local_point& at) {
  if ((side.from.north_m > at.north_m) == (side.to.north_m > at.north_m))
    return false;
  const double share = (at.north_m - side.from.north_m) / (side.to.north_m - side.from.north_m);
  return at.east_m < at_share(side, share).east_m;
}

bool boxes_are_apart(const local_point& low, const local_point& high, const segment& s, double margin_m) {
  return std::max(s.from.east_m, s.to.east_m) + margin_m < low.east_m ||
         std::min(s.from.east_m, s.to.east_m) - margin_m > high.east_m ||
         std::max(s.from.north_m, s.to.north_m) + margin_m < low.north_m ||
         std::min(s.from.north_m, s.to.north_m) - margin_m > high.north_m;
}

bool are_apart(const segment& side, const segment& s, double margin_m) {
  const local_point low{std::min(side.from.east_m, side.to.east_m), std::min(side.from.north_m, side.to.north_m)};
  const local_point high{std::max(side.from.east_m, side.to.east_m), std::max(side.from.north_m, side.to.north_m)};
  return boxes_are_apart(low, high, s, margin_m);
}

} // namespace

flat_polygon::flat_polygon(std::vector<local_point> corners) : corners_(std::move(corners)) {
  GODWIT_ASSERT(corners_.size() >= 3, "geo: a polygon has at least three corners");
  if (twice_the_area(corners_) < 0)
    std::reverse(corners_.begin(), corners_.end());
  low_ = high_ = corners_.front();
  for (const auto& each : corners_) {
    low_ = {std::min(low_.east_m, each.east_m), std::min(low_.north_m, each.north_m)};
    high_ = {std::max(high_.east_m, each.east_m), std::max(high_.north_m, each.north_m)};
  }
}

flat_polygon::flat_polygon(std::span<const point> corners, const local_projection& projection)
    : flat_polygon(projected(corners, projection)) {}

bool flat_polygon::is_farther_than(double margin_m, const segment& s) const {
  return boxes_are_apart(low_, high_, s, margin_m);
}

bool flat_polygon::contains(const local_point& at) const {
  if (is_farther_than(edge_width_m, {at, at}))
    return false;
  bool inside = false;
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    if (distance_m(at, side(i)) <= edge_width_m)
      return true;
    inside = inside != crosses_ray(side(i), at);
  }
  return inside;
}

double flat_polygon::distance_to_sides_m(const segment& s) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < corners_.size(); ++i)
    if (!are_apart(side(i), s, nearest))
      nearest = std::min(nearest, distance_m(s, side(i)));
  return nearest;
}

bool flat_polygon::has_sides_within(double margin_m, const segment& s) const {
  if (is_farther_than(margin_m, s))
    return false;
  for (std::size_t i = 0; i < corners_.size(); ++i)
    if (!are_apart(side(i), s, margin_m) && distance_m(s, side(i)) < margin_m)
      return true;
  return false;
}

bool flat_polygon::contains_with_margin(const local_point& at, double margin_m) const {
  return contains(at) && (!has_sides_within(margin_m, {at, at}));
}

void flat_polygon::add_turning_shares(const segment& s, double margin_m, std::vector<double>& shares) const {
  const double reach_m = std::max(margin_m, edge_width_m);
  if (is_farther_than(reach_m, s))
    return;
  for (std::size_t i = 0; i < corners_.size(); ++i)
    if (!are_apart(side(i), s, reach_m))
      geo::add_turning_shares(s, side(i), margin_m, shares);
}

} // namespace godwit::geo
