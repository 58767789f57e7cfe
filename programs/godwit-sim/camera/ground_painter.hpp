// Paints the bare ground into the picture: each pixel's ray is met with the ground, in blocks of 8 x 8 whose corners
// are exact. Thread: pure.
#pragma once

#include "programs/godwit-sim/camera/canvas.hpp"
#include "programs/godwit-sim/camera/scene.hpp"

namespace godwit::sim::camera {

void paint_ground(canvas& on, const scene& world, const row_views& views);

// Where the ray through a pixel meets the ground; nothing: above the horizon, or almost.
[[nodiscard]] std::optional<vector3> ground_at(const scene& world, const row_views& views, double x, double y);

} // namespace godwit::sim::camera
