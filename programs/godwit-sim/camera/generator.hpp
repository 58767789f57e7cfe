// Makes the picture that a camera would take: a pure function of the scene (its seed), the lens, the view and the time,
// with the truth beside it. The same on each machine of one kind; the choice of numbers is frozen
// (docs/decisions/perception.md).
//
// Made for tests of the detector and for the camera of the simulated vehicle; 640 x 360 takes some 10 ms of a core.
// Thread: const; several at once are fine.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "programs/godwit-sim/camera/scene.hpp"
#include "programs/godwit-sim/camera/view.hpp"

namespace godwit::sim::camera {

// What is really to be seen in a picture of the generator. Pixels of the picture, metres, seconds. Thread: plain
// values.
struct true_mover {
  std::uint32_t id = 0;
  std::string kind;
  // Around all of it that is inside of the picture, also behind a tree.
  double x_px = 0;
  double y_px = 0;
  double width_px = 0;
  double height_px = 0;
  double visible_share = 0; // of its pixels: what nothing hides
  bool is_cut = false;      // by the edge of the picture
  double north_m = 0;       // on the ground below its middle
  double east_m = 0;
  double latitude_deg = 0; // 0 until the scene is put on the Earth (`placed`)
  double longitude_deg = 0;
  double speed_m_s = 0;
  double speed_px_s = 0; // against the ground around it
};

struct truth {
  double time_s = 0;
  camera_view view;
  std::vector<true_mover> movers; // those of which a part is in the picture
};

// With latitudes and longitudes, for a scene whose origin lies there. Source: GeographicLib (local cartesian).
void place_on_earth(truth& what, double origin_latitude_deg, double origin_longitude_deg);

// One line of JSON, with its end of line.
[[nodiscard]] std::string json_line(const truth& what);

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
