// How far along a way there is always an area around it: one of several, which count together where they overlap.
// Thread: pure.
#pragma once

#include <optional>
#include <span>

#include "actors/domain/geo/flat_polygon.hpp"

namespace godwit::geofence {

// A part of a way, as shares of it from 0 to 1; both ends belong to it.
struct part {
  double from = 0;
  double to = 1;
};

// An area, the way over it in the picture of that area, and the part of the way on which the area counts.
struct way_over {
  const geo::flat_polygon* area;
  geo::segment way;
  part counts = {};
};

// The share of the way up to which all of it lies in at least one of AREAS, no nearer than MARGIN to its sides;
// nothing: all of it does. The areas have pictures of their own, so they measure the same way a little differently.
[[nodiscard]] std::optional<double> leaves_at(std::span<const way_over> areas, double margin_m);

} // namespace godwit::geofence
