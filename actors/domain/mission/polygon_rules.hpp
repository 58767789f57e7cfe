// Whether corners make a polygon: at least three different ones, none twice, and no two edges that cross or touch; and
// whether they make a fence, of which vehicles ask less.
//
// Edge i goes from corner i to corner i + 1, the last one back to corner 0; a corner that repeats the first is not
// needed and refused. Longitudes may pass 180 degrees: they are unwrapped to the first corner. The work grows with the
// square of the corners, so callers bound them. Thread: pure.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "messages/mission/place.hpp"

namespace godwit::mission {

// What is wrong, such as "has edges 0 and 2 that cross"; nothing when it is a polygon.
[[nodiscard]] std::optional<std::string> polygon_fault(std::span<const vertex> corners);

// ArduPilot (Polygon_outside) and PX4 (Geofence::insidePolygon) take any three corners or more, and count how often a
// ray from a place crosses their edges: an odd number is inside. Where parts of a fence that crosses itself overlap is
// outside. geo::flat_polygon counts in the same way.
[[nodiscard]] std::optional<std::string> fence_fault(std::span<const vertex> corners);

// Longitudes without a jump: each within 180 degrees of the first.
[[nodiscard]] std::vector<vertex> unwrapped(std::span<const vertex> corners);

// Above 0 when the corners run counter-clockwise as seen from above, in square degrees.
[[nodiscard]] double signed_area(std::span<const vertex> corners);

} // namespace godwit::mission
