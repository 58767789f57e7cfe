#include "actors/executor/plan/survey/best_heading.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace godwit::executor::plan {

namespace {

using geo::local_point;

constexpr double degrees_per_rad = 180 / std::numbers::pi;
constexpr double half_turn_deg = 180;

// Widths that differ by less are the same: the first side wins, so that rounding does not decide.
constexpr double same_width_m = 0.001;

double turn(const local_point& a, const local_point& b, const local_point& c) {
  return (b.east_m - a.east_m) * (c.north_m - a.north_m) - (b.north_m - a.north_m) * (c.east_m - a.east_m);
}

// Half of the hull, from the first to the last of POINTS, which are sorted.
void add_chain(const std::vector<local_point>& points, std::vector<local_point>& hull) {
  const auto begin = hull.size();
  for (const auto& each : points) {
    while (hull.size() >= begin + 2 && turn(hull[hull.size() - 2], hull.back(), each) <= 0)
      hull.pop_back();
    hull.push_back(each);
  }
  hull.pop_back(); // the other half begins there
}

std::vector<local_point> hull_of(std::span<const local_point> corners) {
  std::vector<local_point> sorted(corners.begin(), corners.end());
  std::sort(sorted.begin(), sorted.end(), [](const local_point& a, const local_point& b) {
    return a.east_m < b.east_m || (a.east_m == b.east_m && a.north_m < b.north_m);
  });
  std::vector<local_point> hull;
  add_chain(sorted, hull);
  std::reverse(sorted.begin(), sorted.end());
  add_chain(sorted, hull);
  return hull;
}

double width_m(const std::vector<local_point>& hull, const local_point& from, const local_point& to) {
  const double length = std::hypot(to.east_m - from.east_m, to.north_m - from.north_m);
  double widest = 0;
  for (const auto& each : hull)
    widest = std::max(widest, turn(from, to, each) / length);
  return widest;
}

double heading_of(const local_point& from, const local_point& to) {
  const double heading = std::atan2(to.east_m - from.east_m, to.north_m - from.north_m) * degrees_per_rad;
  const double folded = std::fmod(heading + 2 * half_turn_deg, half_turn_deg);
  return folded < half_turn_deg ? folded : 0;
}

} // namespace

double best_heading_deg(std::span<const local_point> corners) {
  const auto hull = hull_of(corners);
  double best_deg = 0;
  double narrowest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const auto& from = hull[i];
    const auto& to = hull[(i + 1) % hull.size()];
    const double width = width_m(hull, from, to);
    if (width < narrowest - same_width_m) {
      narrowest = width;
      best_deg = heading_of(from, to);
    }
  }
  return best_deg;
}

} // namespace godwit::executor::plan
