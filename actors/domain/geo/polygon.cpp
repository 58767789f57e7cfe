#include "actors/domain/geo/polygon.hpp"

#include <algorithm>

#include "runtime/assert.hpp"

namespace godwit::geo {

namespace {

const point& first_of(const std::vector<point>& vertices) {
  GODWIT_ASSERT(vertices.size() >= 3, "geo: a polygon has at least three vertices");
  return vertices.front();
}

} // namespace

polygon::polygon(const std::vector<point>& vertices)
    : first_(first_of(vertices)), projection_(first_), area_(vertices, projection_) {
  for (const auto& each : area_.corners())
    radius_m_ = std::max(radius_m_, length_m(each) + edge_width_m);
}

} // namespace godwit::geo
