// An area on the ground with straight sides, for areas of up to some tens of kilometres.
//
// Sides are straight in the local projection around the first vertex: against a geodesic side of 10 km that is less
// than a centimetre. The last vertex is joined to the first. What lies on a side is inside. A polygon may lie across
// the antimeridian or around a pole. Thread: pure.
#pragma once

#include <vector>

#include "actors/domain/geo/local_projection.hpp"

namespace godwit::geo {

class polygon {
public:
  // At least three valid vertices, in either sense of rotation.
  explicit polygon(const std::vector<point>& vertices);

  [[nodiscard]] bool contains(const point& at) const;

  // A circle around the first vertex with the whole polygon in it.
  [[nodiscard]] const point& centre() const { return first_; }
  [[nodiscard]] double radius_m() const { return radius_m_; }

private:
  point first_;
  local_projection projection_;
  std::vector<local_point> vertices_;
  double radius_m_ = 0;
};

} // namespace godwit::geo
