#include "actors/mapobjects_store/view.hpp"

#include "actors/mapobjects_store/geo_point.hpp"

namespace godwit::mapobjects_store {

std::vector<view_area> areas_of(const pass_end& pass) {
  std::vector<view_area> areas;
  for (const auto& each : pass.circles)
    areas.emplace_back(circle_area{point_of(each.centre), each.radius_m});
  for (const auto& each : pass.polygons) {
    std::vector<geo::point> vertices;
    for (const auto& vertex : each.vertices)
      vertices.push_back(point_of(vertex));
    areas.emplace_back(geo::polygon(vertices));
  }
  return areas;
}

bool contains(const view_area& area, const geo::point& at) {
  if (const auto* circle = std::get_if<circle_area>(&area))
    return geo::distance_m(circle->centre, at) <= circle->radius_m;
  return std::get<geo::polygon>(area).contains(at);
}

std::vector<geo::bounding_box> boxes_of(const view_area& area) {
  if (const auto* circle = std::get_if<circle_area>(&area))
    return geo::boxes_around(circle->centre, circle->radius_m);
  const auto& polygon = std::get<geo::polygon>(area);
  return geo::boxes_around(polygon.centre(), polygon.radius_m());
}

} // namespace godwit::mapobjects_store
