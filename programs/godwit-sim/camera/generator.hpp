// Makes the picture that a camera would take: a pure function of the scene (its seed), the lens, the view and the time,
// with the truth beside it. The same on each machine of one kind; the choice of numbers is frozen
// (docs/decisions/perception.md).
//
// Made for tests of the detector and for the camera of the simulated vehicle; 640 x 360 takes some 10 ms of a core.
// Thread: const; several at once are fine.
#pragma once

#include <cstdint>
#include <vector>

#include "programs/godwit-sim/camera/scene.hpp"
#include "programs/godwit-sim/camera/truth.hpp"
#include "programs/godwit-sim/camera/view.hpp"

namespace godwit::sim::camera {

struct picture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> grey; // row by row, without gaps
};

struct shot {
  picture seen;
  truth real;
};

class generator {
public:
  static constexpr std::size_t max_movers = 200; // of a scene; more are cut off

  generator(scene_settings settings, const lens& glass);

  [[nodiscard]] shot take(const camera_view& view) const;
  [[nodiscard]] const lens& glass() const { return lens_; }
  [[nodiscard]] const scene& world() const { return scene_; }

private:
  scene scene_;
  lens lens_;
};

// Three bytes a pixel, blue first: tinted by brightness, as grass and stone are.
[[nodiscard]] std::vector<std::uint8_t> bgr_of(const picture& grey);

} // namespace godwit::sim::camera
