// The shortest way between two of many places, over places from which the next one can be seen (A* with the straight
// distance as what is left at least).
//
// Whether one place sees another is asked only when it matters, at most once for each pair. The work grows with the
// square of the places, so callers bound them. Thread: pure.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "actors/domain/geo/plane.hpp"

namespace godwit::route {

using geo::local_point;
using sees = std::function<bool(std::size_t from, std::size_t to)>;

// The places on the way, the first and the last included; empty when there is no way.
[[nodiscard]] std::vector<std::size_t> shortest_path(const std::vector<local_point>& places, std::size_t first,
                                                     std::size_t last, const sees& can_see);

} // namespace godwit::route
