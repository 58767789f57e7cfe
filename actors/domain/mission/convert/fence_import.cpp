#include "actors/domain/mission/convert/fence_import.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "actors/domain/mission/convert/vehicle_item.hpp"

namespace godwit::mission {

namespace {

constexpr std::int64_t known_version = 2;
constexpr double smallest_metres_a_degree = 110'574; // of latitude, at the equator (WGS 84)
constexpr double largest_metres_a_degree = 111'694;  // at the poles
constexpr double highest_latitude = 80;              // beyond, a degree of longitude changes too much in a circle
constexpr double largest_radius_m = 100'000;

// Nothing where the file does not say it: the one kind keeps the vehicle in, the other keeps it out. The problem is
// noted.
std::optional<fence_kind> kind_of_fence(plan_source& source, const plan_node& node) {
  const auto before = source.problems.size();
  const bool is_inclusion = source.flag(node, "inclusion");
  if (source.problems.size() != before)
    return std::nullopt;
  return is_inclusion ? fence_kind::inclusion : fence_kind::exclusion;
}

// Above home; without a height on the ground.
position position_of(const std::array<double, 3>& at) { return {at[0], at[1], std::isfinite(at[2]) ? at[2] : 0}; }

void import_polygon(plan_source& source, const plan_node& node, imported_fences& fences) {
  if (const auto kind = kind_of_fence(source, node)) {
    fences.all.push_back({*kind, source.corners(node, "polygon"), {}, {}});
    fences.places.push_back({pointer_to(node.pointer, "polygon"), {}});
  }
}

void import_circle(plan_source& source, const plan_node& node, imported_fences& fences) {
  const auto circle = source.object(node, "circle");
  const auto centre = source.place(circle, "center");
  const auto radius_m = source.number(circle, "radius");
  const auto kind = kind_of_fence(source, node);
  if (!kind)
    return;
  auto corners = polygon_of_circle({centre[0], centre[1]}, radius_m, *kind);
  if (!corners) {
    source.losses.add({{},
                       "fence: circle of " + number_text(radius_m) + " m",
                       "no polygon can be made of it, by which it could be judged",
                       "left out"});
    return;
  }
  fences.all.push_back({*kind, std::move(*corners), {}, {}, fence_circle{centre[0], centre[1], radius_m}});
  fences.places.push_back({circle.pointer, {}});
}

// Version 1 stands in plans of an older form, mostly with nothing in it.
bool is_without_content(const plan_node& node) {
  for (const auto& [key, value] : node.value->items())
    if (key != "version" && !(value.is_array() && value.empty()))
      return false;
  return true;
}

bool has_known_version(plan_source& source, const plan_node& node, const std::string& name) {
  const auto version = source.integer(node, "version");
  if (version == known_version)
    return true;
  if (!is_without_content(node))
    source.losses.add({{}, name + " of version " + std::to_string(version), "its form is not known", "left out"});
  return false;
}

} // namespace

std::optional<std::vector<vertex>> polygon_of_circle(const vertex& centre, double radius_m, fence_kind kind) {
  const bool is_possible = std::abs(centre.latitude) <= highest_latitude && std::isfinite(centre.longitude) &&
                           radius_m > 0 && radius_m <= largest_radius_m;
  if (!is_possible)
    return std::nullopt;
  // The corners of a polygon around a circle lie further out than the circle; its edges touch it.
  const bool is_around = kind == fence_kind::exclusion;
  const auto step = 2 * std::numbers::pi / static_cast<double>(corners_of_circle);
  const auto corner_m = is_around ? radius_m / std::cos(step / 2) : radius_m;
  const auto north_deg = corner_m / (is_around ? smallest_metres_a_degree : largest_metres_a_degree);
  // The degree of longitude is shortest on the side of the pole and longest on that of the equator.
  const auto edge = std::abs(centre.latitude) + (is_around ? north_deg : -north_deg);
  const auto east_deg = north_deg / std::cos(std::max(edge, 0.0) * std::numbers::pi / 180);
  std::vector<vertex> corners;
  for (std::size_t i = 0; i < corners_of_circle; ++i) {
    const auto angle = static_cast<double>(i) * step;
    const auto longitude = centre.longitude + east_deg * std::cos(angle);
    corners.push_back({centre.latitude + north_deg * std::sin(angle), std::remainder(longitude, 360)});
  }
  return corners;
}

imported_fences import_fence(plan_source& source, const plan_node& fence) {
  imported_fences fences;
  if (!has_known_version(source, fence, "fence"))
    return fences;
  source.lose_unknown(fence, {"breachReturn", "circles", "polygons", "version"});
  if (fence.has("breachReturn"))
    fences.breach_return_point = position_of(source.place(fence, "breachReturn"));
  for (const auto& each : source.list(fence, "polygons"))
    import_polygon(source, each, fences);
  for (const auto& each : source.list(fence, "circles"))
    import_circle(source, each, fences);
  return fences;
}

std::optional<std::vector<position>> import_rally_points(plan_source& source, const plan_node& rally) {
  std::vector<position> points;
  if (has_known_version(source, rally, "rally points"))
    for (const auto& each : source.list(rally, "points"))
      points.push_back(position_of(source.numbers(each)));
  return points.empty() ? std::nullopt : std::optional(std::move(points));
}

} // namespace godwit::mission
