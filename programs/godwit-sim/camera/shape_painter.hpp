// Paints what stands on the ground, from far to near, with its shadows below it. Thread: pure.
#pragma once

#include "programs/godwit-sim/camera/canvas.hpp"
#include "programs/godwit-sim/camera/scene.hpp"

namespace godwit::sim::camera {

// PAINTED_BY_MOVER: how many pixels each mover has been given, before others hid them; index 0 is unused.
void paint_shapes(canvas& on, const scene& world, const shapes& what, const row_views& views,
                  std::vector<int>& painted_by_mover);

// The corners of a box: four on the ground, four above them.
[[nodiscard]] std::array<vector3, 8> corners_of(const box_shape& box);

} // namespace godwit::sim::camera
