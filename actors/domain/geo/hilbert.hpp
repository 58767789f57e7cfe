// The place of a point on a curve that fills the globe: points that are near each other mostly have near places on it.
// Whoever puts many points into a tree of boxes does it in this order, so that each box is filled at once.
//
// Thread: pure. Source: D. Hilbert, Ueber die stetige Abbildung einer Linie auf ein Flaechenstueck (1891); the turning
// of the quadrants as in J. Skilling, Programming the Hilbert Curve (2004).
#pragma once

#include <cstdint>

#include "actors/domain/geo/point.hpp"

namespace godwit::geo {

// Of a valid point. Cells are of 0.01 m and less.
[[nodiscard]] std::uint64_t hilbert_place(const point& at);

} // namespace godwit::geo
