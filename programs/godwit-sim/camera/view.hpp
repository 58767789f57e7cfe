// Where the camera is and how it maps the world into a picture: a pinhole without distortion, with a rolling shutter.
//
// World: metres north, east and down of the scene's origin, which lies on the ground. Camera axes: x to the right of
// the picture, y to its lower edge, z into it. Pixel (0, 0) is the middle of the upper left one. Thread: plain values.
#pragma once

#include <array>
#include <optional>

namespace godwit::sim::camera {

struct vector3 {
  double x = 0; // north
  double y = 0; // east
  double z = 0; // down
};

struct point2 {
  double x = 0;
  double y = 0;
};

// From camera axes to the world; rows.
using rotation = std::array<vector3, 3>;

// Angles in radians: heading of the picture's upper edge from north, tilt of the view off the nadir (towards that
// heading), roll around the line of sight.
[[nodiscard]] rotation rotation_of(double heading_rad, double off_nadir_rad, double roll_rad);
[[nodiscard]] rotation rotation_of_quaternion(double w, double x, double y, double z);
// BY is a rotation vector in camera axes, in radians.
[[nodiscard]] rotation turned(const rotation& attitude, const vector3& by);
// The rotation vector in camera axes that turns FROM into TO.
[[nodiscard]] vector3 turn_between(const rotation& from, const rotation& to);
[[nodiscard]] std::array<double, 4> quaternion_of(const rotation& attitude); // w, x, y, z; w >= 0

struct lens {
  int width = 1280;
  int height = 720;
  double focal_px = 1100; // at zoom 1
  double readout_s = 0;   // from the first row to the last; 0: a global shutter
};

// At the moment in which the middle row is exposed.
struct camera_view {
  double time_s = 0; // of the scene
  vector3 position;  // z is negative: above the origin
  vector3 velocity;  // metres a second
  rotation attitude{{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}};
  vector3 rate; // in camera axes, radians a second
  double zoom = 1;
};

// The view of one row.
class row_views {
public:
  row_views(const lens& glass, const camera_view& middle) : lens_(glass), middle_(middle) {}

  [[nodiscard]] camera_view at_row(double row) const;
  // Through pixel X of ROW, into the world; not of length 1.
  [[nodiscard]] static vector3 ray(const lens& glass, const camera_view& view, double x, double row);
  // Nothing: behind the camera. Rows outside of the picture take the view of the nearest one inside.
  [[nodiscard]] std::optional<point2> project(const vector3& world) const;
  [[nodiscard]] const camera_view& middle() const { return middle_; }
  [[nodiscard]] const lens& glass() const { return lens_; }

private:
  lens lens_;
  camera_view middle_;
};

} // namespace godwit::sim::camera
