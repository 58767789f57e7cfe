// What lies, stands and moves on the ground: all of it follows from the seed, for any place and any time.
//
// The ground has no end: what stands on it is drawn by lot for each cell of a grid. Tier A is a plane with a texture;
// tier B has relief, buildings, trees that sway, shadows, clouds and glints. Metres and seconds; brightness 0..255.
// Thread: const after it was made.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "programs/godwit-sim/camera/texture.hpp"
#include "programs/godwit-sim/camera/view.hpp"

namespace godwit::sim::camera {

// Moves along an arc; stops now and then where `pause_every_s` is not 0.
struct mover {
  std::uint32_t id = 0;
  std::string kind = "vehicle"; // person, animal, vehicle
  point2 start;                 // x north, y east, at time 0
  double heading_rad = 0;       // at time 0
  double speed_m_s = 1;
  double turn_rad_s = 0;
  double pause_every_s = 0; // a quarter of each such time it stands still
  double length_m = 4;
  double width_m = 2;
  double height_m = 1.5;
  int brightness = 200;
};

struct mover_place {
  point2 at;
  double heading_rad = 0;
  double speed_m_s = 0;
};

[[nodiscard]] mover_place place_of(const mover& who, double time_s);

// A brightness change of the camera at one moment, which its automatic exposure takes back within a second.
struct exposure_step {
  double at_s = 0;
  double factor = 1;
};

struct sensor_settings {
  double noise = 2; // standard deviation
  std::vector<exposure_step> steps;
  int jpeg_quality = 0;  // 1 to 100: blocks of 8 x 8 as JPEG makes them; 0: none
  int defocus_px = 0;    // radius of a blur; 0: sharp
  double brightness = 1; // of all, 0.02: night
};

struct scene_settings {
  std::uint64_t seed = 0;
  ground_style style;
  double relief_m = 0; // standard deviation of the ground's height; 0: a plane
  double buildings_a_cell = 0;
  double trees_a_cell = 0;
  double glints_a_cell = 0;
  bool has_shadows = false;
  bool has_clouds = false;
  std::vector<mover> movers;
  sensor_settings sensor;
};

// The settings with all that tier B has, and with nothing of it.
[[nodiscard]] scene_settings tier_a(std::uint64_t seed);
[[nodiscard]] scene_settings tier_b(std::uint64_t seed);

// A box on the ground: a building, or a mover at one moment.
struct box_shape {
  point2 centre;
  double base_z = 0; // down
  double heading_rad = 0;
  double length_m = 0;
  double width_m = 0;
  double height_m = 0;
  int brightness = 0;
  std::uint32_t pattern = 0; // where in the texture its surface lies
  std::uint32_t mover = 0;   // its number in the list, from 1; 0: a building
};

struct crown_shape { // of a tree
  vector3 centre;
  double radius_m = 0;
  double base_z = 0; // of the ground below it
  int brightness = 0;
  std::uint32_t pattern = 0;
};

struct glint_shape {
  vector3 at;
  double radius_px = 1;
};

struct shapes {
  std::vector<box_shape> boxes;
  std::vector<crown_shape> crowns;
  std::vector<glint_shape> glints;
};

class scene {
public:
  static constexpr double cell_m = 40;
  static constexpr int max_cells = 400; // of a view; the nearest to its middle

  explicit scene(scene_settings settings);

  [[nodiscard]] const scene_settings& settings() const { return settings_; }
  [[nodiscard]] const texture& ground() const { return ground_; }
  // Down: negative on a hill.
  [[nodiscard]] double ground_z(double north_m, double east_m) const;
  // Added to the brightness of the texture, so that its repetition is hidden.
  [[nodiscard]] double large_areas(double north_m, double east_m) const { return areas_.at(north_m, east_m); }
  // 1 in the sun, less below a cloud.
  [[nodiscard]] double sunlight(double north_m, double east_m, double time_s) const;
  // Where the shadow of a point one metre above the ground falls, from below it.
  [[nodiscard]] point2 shadow_of_metre() const { return shadow_; }
  // What there is within REACH_M of a place.
  [[nodiscard]] shapes around(const point2& middle, double reach_m, double time_s) const;

private:
  void add_cell(shapes& to, int row, int column, double time_s) const;

  scene_settings settings_;
  texture ground_;
  smooth_field relief_;
  smooth_field areas_;
  smooth_field clouds_;
  point2 shadow_;
};

} // namespace godwit::sim::camera
