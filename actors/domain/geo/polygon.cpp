#include "actors/domain/geo/polygon.hpp"

#include <algorithm>

#include "runtime/assert.hpp"

namespace godwit::geo {

namespace {

// What is nearer than this to a side lies on it: a millimetre is less than any position is known to.
constexpr double edge_width_m = 0.001;

const point& first_of(const std::vector<point>& vertices) {
  GODWIT_ASSERT(vertices.size() >= 3, "geo: a polygon has at least three vertices");
  return vertices.front();
}

bool on_side(const local_point& a, const local_point& b, const local_point& at) {
  const double east = b.east_m - a.east_m;
  const double north = b.north_m - a.north_m;
  const double length_squared = east * east + north * north;
  const double along = (at.east_m - a.east_m) * east + (at.north_m - a.north_m) * north;
  const double share = length_squared > 0 ? std::clamp(along / length_squared, 0.0, 1.0) : 0;
  return std::hypot(at.east_m - a.east_m - share * east, at.north_m - a.north_m - share * north) <= edge_width_m;
}

// Whether a ray from AT to the east crosses the side. Each side owns its lower end only, so that a vertex counts once.
bool crosses(const local_point& a, const local_point& b, const local_point& at) {
  if ((a.north_m > at.north_m) == (b.north_m > at.north_m))
    return false;
  const double share = (at.north_m - a.north_m) / (b.north_m - a.north_m);
  return at.east_m < a.east_m + share * (b.east_m - a.east_m);
}

} // namespace

polygon::polygon(const std::vector<point>& vertices) : first_(first_of(vertices)), projection_(first_) {
  for (const auto& each : vertices) {
    const auto& local = vertices_.emplace_back(projection_.to_local(each));
    radius_m_ = std::max(radius_m_, std::hypot(local.east_m, local.north_m));
  }
  radius_m_ += edge_width_m;
}

bool polygon::contains(const point& at) const {
  const auto local = projection_.to_local(at);
  bool inside = false;
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    const auto& a = vertices_[i];
    const auto& b = vertices_[(i + 1) % vertices_.size()];
    if (on_side(a, b, local))
      return true;
    inside = inside != crosses(a, b, local);
  }
  return inside;
}

} // namespace godwit::geo
