// The heading of lines over an area that needs the fewest of them: along the side of its hull across which it is
// narrowest. Thread: pure.
#pragma once

#include <span>

#include "actors/domain/geo/local_projection.hpp"

namespace godwit::executor::plan {

// Degrees clockwise from north, from 0 to below 180. At least three corners.
[[nodiscard]] double best_heading_deg(std::span<const geo::local_point> corners);

} // namespace godwit::executor::plan
