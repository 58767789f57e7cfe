// The places at which a shortest way around fences may turn: around the corners of exclusions, around the corners at
// which an inclusion is dented, and where one inclusion goes over into another.
//
//            o   o              Around a corner the ways at the margin form an arc. Each of its parts of up to 45
//            degrees
//         o  ____               becomes one point, so far out that the straight way to the next point keeps the margin
//            |                  too. A way over these points is at most a few per cent of the margin longer.
//         o  |
//
// Thread: pure.
#pragma once

#include <vector>

#include "actors/domain/route/clear_space.hpp"

namespace godwit::route {

// Only those that are clear.
[[nodiscard]] std::vector<local_point> corner_points(const clear_space& space);

} // namespace godwit::route
