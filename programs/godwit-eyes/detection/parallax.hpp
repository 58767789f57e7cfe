// Whether a track moves as something high and still would: a tree, a mast or a roof goes over the ground in the picture
// when the camera passes it, always away from where the camera flies. Source: plane plus parallax (Irani and Anandan
// 1996). Thread: pure.
#pragma once

#include <Eigen/Core>

#include "programs/godwit-eyes/ground/sight.hpp"

namespace godwit::eyes {

// PLACE and VELOCITY (against the ground, a second) in pixels of the picture; CAMERA_VELOCITY north, east, down in
// metres a second. Things up to 15 m or a third of the camera's height are thought of.
[[nodiscard]] bool is_like_parallax(const sight& from, const Eigen::Vector3d& camera_velocity,
                                    const Eigen::Vector2d& place, const Eigen::Vector2d& velocity);

} // namespace godwit::eyes
