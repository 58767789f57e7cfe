// Whether a track moves as something high and still would: a tree, a mast or a roof goes over the ground in the picture
// when the camera passes it, always away from where the camera flies. Source: plane plus parallax (Irani and Anandan
// 1996). Thread: pure.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "programs/godwit-eyes/ground/sight.hpp"

namespace godwit::eyes {

struct still_motion {
  Eigen::Vector2d fastest_px_s; // of the highest that is thought of, against the ground
  double pixels_a_metre = 0;    // on the ground there
};
// Nothing: PLACE is at or above the horizon, or the camera lies on the ground.
[[nodiscard]] std::optional<still_motion> still_motion_at(const sight& from, const Eigen::Vector3d& camera_velocity,
                                                          const Eigen::Vector2d& place);

// PLACE and VELOCITY (against the ground, a second) in pixels of the picture; CAMERA_VELOCITY north, east, down in
// metres a second. Things up to 15 m or a third of the camera's height are thought of.
[[nodiscard]] bool is_like_parallax(const sight& from, const Eigen::Vector3d& camera_velocity,
                                    const Eigen::Vector2d& place, const Eigen::Vector2d& velocity);

} // namespace godwit::eyes
