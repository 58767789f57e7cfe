// What the camera does to the light: focus, exposure, noise, and the blocks of its encoder. Thread: pure.
#pragma once

#include "programs/godwit-sim/camera/canvas.hpp"
#include "programs/godwit-sim/camera/scene.hpp"

namespace godwit::sim::camera {

// The noise is that of SEED and the moment.
void expose(canvas& picture, const sensor_settings& settings, std::uint64_t seed, double time_s);

// Blocks of 8 x 8 through a cosine transform and the table of JPEG's Annex K at QUALITY, 1 to 100.
void compress(canvas& picture, int quality);

} // namespace godwit::sim::camera
