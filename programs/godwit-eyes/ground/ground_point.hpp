// Where on the Earth a pixel looks, and how sure that is.
//
// The ground is taken for level; a hill as high as a tenth of the camera's height moves the point by a tenth of its
// distance. The covariance holds what the pose says of itself: attitude (the same in all three axes), position, height,
// and one pixel. Error of the distance at an angle T off the nadir from an attitude error D: height * D / cos^2(T).
// Thread: pure.
#pragma once

#include <optional>

#include "programs/godwit-eyes/detection/detector.hpp"
#include "programs/godwit-eyes/ground/sight.hpp"

namespace godwit::eyes {

// Of the middle of BOX; nothing: it looks more than LIMIT off the nadir.
[[nodiscard]] std::optional<ground_place> ground_point(const sight& from, const pixel_box& box, double limit_rad);

} // namespace godwit::eyes
