#include "actors/domain/mission/polygon_rules.hpp"

#include <algorithm>

namespace godwit::mission {

namespace {

// Above 0 when C lies to the left of the line from A to B.
double side(const vertex& a, const vertex& b, const vertex& c) {
  return (b.longitude - a.longitude) * (c.latitude - a.latitude) -
         (b.latitude - a.latitude) * (c.longitude - a.longitude);
}

int sign(double value) { return value > 0 ? 1 : value < 0 ? -1 : 0; }

// C is on the line through A and B: whether it lies between them.
bool is_between(const vertex& a, const vertex& b, const vertex& c) {
  return std::min(a.longitude, b.longitude) <= c.longitude && c.longitude <= std::max(a.longitude, b.longitude) &&
         std::min(a.latitude, b.latitude) <= c.latitude && c.latitude <= std::max(a.latitude, b.latitude);
}

bool meet(const vertex& a, const vertex& b, const vertex& c, const vertex& d) {
  const auto c_side = sign(side(a, b, c));
  const auto d_side = sign(side(a, b, d));
  const auto a_side = sign(side(c, d, a));
  const auto b_side = sign(side(c, d, b));
  if (c_side * d_side < 0 && a_side * b_side < 0)
    return true;
  return (c_side == 0 && is_between(a, b, c)) || (d_side == 0 && is_between(a, b, d)) ||
         (a_side == 0 && is_between(c, d, a)) || (b_side == 0 && is_between(c, d, b));
}

// Edge A-B, then B-C: whether the second goes back along the first.
bool folds_back(const vertex& a, const vertex& b, const vertex& c) {
  const auto along =
      (b.longitude - a.longitude) * (c.longitude - b.longitude) + (b.latitude - a.latitude) * (c.latitude - b.latitude);
  return side(a, b, c) == 0 && along < 0;
}

std::optional<std::string> repeated_corner(std::span<const vertex> corners) {
  for (std::size_t later = 1; later < corners.size(); ++later)
    for (std::size_t earlier = 0; earlier < later; ++earlier)
      if (corners[earlier] == corners[later])
        return "has corner " + std::to_string(later) + " at the place of corner " + std::to_string(earlier);
  return std::nullopt;
}

} // namespace

std::vector<vertex> unwrapped(std::span<const vertex> corners) {
  std::vector<vertex> result(corners.begin(), corners.end());
  for (auto& each : result) {
    const auto from_first = each.longitude - corners[0].longitude;
    each.longitude += from_first > 180 ? -360 : from_first < -180 ? 360 : 0;
  }
  return result;
}

std::optional<std::string> polygon_fault(std::span<const vertex> corners) {
  const auto count = corners.size();
  if (count < 3)
    return "has " + std::to_string(count) + " corners";
  const auto flat = unwrapped(corners);
  if (auto repeated = repeated_corner(flat))
    return repeated;
  const auto corner = [&](std::size_t i) -> const vertex& { return flat[i % count]; };
  const auto edges = [](std::size_t first, std::size_t second, const char* what) {
    return "has edges " + std::to_string(first) + " and " + std::to_string(second) + " that " + what;
  };
  for (std::size_t i = 0; i < count; ++i)
    if (folds_back(corner(i), corner(i + 1), corner(i + 2)))
      return edges(i, (i + 1) % count, "lie on each other");
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = i + 2; j < count; ++j)
      if ((j + 1) % count != i && meet(corner(i), corner(i + 1), corner(j), corner(j + 1)))
        return edges(i, j, "cross or touch");
  return std::nullopt;
}

std::optional<std::string> fence_fault(std::span<const vertex> corners) {
  constexpr std::size_t least_corners = 3;
  std::vector<vertex> different;
  for (const auto& each : unwrapped(corners))
    if (different.size() < least_corners && std::ranges::find(different, each) == different.end())
      different.push_back(each);
  return different.size() < least_corners
             ? std::optional("has " + std::to_string(different.size()) + " different corners")
             : std::nullopt;
}

double signed_area(std::span<const vertex> corners) {
  const auto flat = unwrapped(corners);
  double doubled = 0;
  for (std::size_t i = 0; i < flat.size(); ++i) {
    const auto& a = flat[i];
    const auto& b = flat[(i + 1) % flat.size()];
    doubled += a.longitude * b.latitude - b.longitude * a.latitude;
  }
  return doubled / 2;
}

} // namespace godwit::mission
