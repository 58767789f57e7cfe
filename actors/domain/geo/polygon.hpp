// An area on the ground with straight sides, for areas of up to some tens of kilometres.
//
// Sides are straight in the local projection around the first vertex: against a geodesic side of 10 km that is less
// than a centimetre. The last vertex is joined to the first. What lies on a side is inside. A polygon may lie across
// the antimeridian or around a pole. Thread: pure.
#pragma once

#include <vector>

#include "actors/domain/geo/flat_polygon.hpp"
#include "actors/domain/geo/local_projection.hpp"

namespace godwit::geo {

class polygon {
public:
  // At least three valid vertices, in either sense of rotation.
  explicit polygon(const std::vector<point>& vertices);

  [[nodiscard]] bool contains(const point& at) const { return area_.contains(projection_.to_local(at)); }

  // The area, and a way over it, in the projection around the first vertex.
  [[nodiscard]] const flat_polygon& flat() const { return area_; }
  [[nodiscard]] segment flat(const point& from, const point& to) const {
    return {projection_.to_local(from), projection_.to_local(to)};
  }

  // A circle around the first vertex with the whole polygon in it.
  [[nodiscard]] const point& centre() const { return first_; }
  [[nodiscard]] double radius_m() const { return radius_m_; }

private:
  point first_;
  local_projection projection_;
  flat_polygon area_;
  double radius_m_ = edge_width_m;
};

} // namespace godwit::geo
