#include "programs/godwit-sim/camera/view.hpp"

#include <algorithm>
#include <cmath>

namespace godwit::sim::camera {

namespace {

constexpr double nearest_m = 0.5; // what is nearer than this is behind the camera

vector3 turned_vector(const rotation& by, const vector3& v) {
  return {by[0].x * v.x + by[0].y * v.y + by[0].z * v.z, by[1].x * v.x + by[1].y * v.y + by[1].z * v.z,
          by[2].x * v.x + by[2].y * v.y + by[2].z * v.z};
}

vector3 turned_back(const rotation& by, const vector3& v) {
  return {by[0].x * v.x + by[1].x * v.y + by[2].x * v.z, by[0].y * v.x + by[1].y * v.y + by[2].y * v.z,
          by[0].z * v.x + by[1].z * v.y + by[2].z * v.z};
}

rotation product(const rotation& a, const rotation& b) {
  rotation result;
  for (std::size_t row = 0; row < 3; ++row)
    result[row] = {a[row].x * b[0].x + a[row].y * b[1].x + a[row].z * b[2].x,
                   a[row].x * b[0].y + a[row].y * b[1].y + a[row].z * b[2].y,
                   a[row].x * b[0].z + a[row].y * b[1].z + a[row].z * b[2].z};
  return result;
}

// Rodrigues.
rotation rotation_of_vector(const vector3& v) {
  const double angle = std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
  const double a = angle < 1e-9 ? 1 : std::sin(angle) / angle;
  const double b = angle < 1e-9 ? 0.5 : (1 - std::cos(angle)) / (angle * angle);
  return {{{1 - b * (v.y * v.y + v.z * v.z), b * v.x * v.y - a * v.z, b * v.x * v.z + a * v.y},
           {b * v.x * v.y + a * v.z, 1 - b * (v.x * v.x + v.z * v.z), b * v.y * v.z - a * v.x},
           {b * v.x * v.z - a * v.y, b * v.y * v.z + a * v.x, 1 - b * (v.x * v.x + v.y * v.y)}}};
}

} // namespace

rotation rotation_of(double heading_rad, double off_nadir_rad, double roll_rad) {
  // Straight down with the upper edge to the north, tilted up around the camera's x, turned by the heading.
  const rotation down{{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}};
  const double c = std::cos(heading_rad);
  const double s = std::sin(heading_rad);
  const rotation turn{{{c, -s, 0}, {s, c, 0}, {0, 0, 1}}};
  const rotation tilt = rotation_of_vector({off_nadir_rad, 0, 0});
  return product(product(product(turn, down), tilt), rotation_of_vector({0, 0, roll_rad}));
}

rotation rotation_of_quaternion(double w, double x, double y, double z) {
  return {{{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
           {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
           {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}}};
}

rotation turned(const rotation& attitude, const vector3& by) { return product(attitude, rotation_of_vector(by)); }

vector3 turn_between(const rotation& from, const rotation& to) {
  const rotation transposed{
      {{from[0].x, from[1].x, from[2].x}, {from[0].y, from[1].y, from[2].y}, {from[0].z, from[1].z, from[2].z}}};
  const auto q = quaternion_of(product(transposed, to));
  const double sine = std::sqrt(q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  const double scale = sine < 1e-12 ? 2 : 2 * std::atan2(sine, q[0]) / sine;
  return {q[1] * scale, q[2] * scale, q[3] * scale};
}

std::array<double, 4> quaternion_of(const rotation& r) {
  const auto root = [](double v) { return std::sqrt(std::max(v, 0.0)) / 2; };
  std::array<double, 4> q{root(1 + r[0].x + r[1].y + r[2].z), root(1 + r[0].x - r[1].y - r[2].z),
                          root(1 - r[0].x + r[1].y - r[2].z), root(1 - r[0].x - r[1].y + r[2].z)};
  // The largest part gives the signs of the others.
  const auto largest = std::max_element(q.begin(), q.end()) - q.begin();
  const double d = 4 * q[static_cast<std::size_t>(largest)];
  if (largest == 0)
    return {q[0], (r[2].y - r[1].z) / d, (r[0].z - r[2].x) / d, (r[1].x - r[0].y) / d};
  if (largest == 1)
    q = {(r[2].y - r[1].z) / d, q[1], (r[0].y + r[1].x) / d, (r[0].z + r[2].x) / d};
  else if (largest == 2)
    q = {(r[0].z - r[2].x) / d, (r[0].y + r[1].x) / d, q[2], (r[1].z + r[2].y) / d};
  else
    q = {(r[1].x - r[0].y) / d, (r[0].z + r[2].x) / d, (r[1].z + r[2].y) / d, q[3]};
  if (q[0] < 0)
    q = {-q[0], -q[1], -q[2], -q[3]};
  return q;
}

camera_view row_views::at_row(double row) const {
  if (lens_.readout_s == 0)
    return middle_;
  const double inside = std::clamp(row, 0.0, lens_.height - 1.0);
  const double dt = lens_.readout_s * (inside / (lens_.height - 1) - 0.5);
  camera_view view = middle_;
  view.position = {view.position.x + view.velocity.x * dt, view.position.y + view.velocity.y * dt,
                   view.position.z + view.velocity.z * dt};
  view.attitude = turned(view.attitude, {view.rate.x * dt, view.rate.y * dt, view.rate.z * dt});
  return view;
}

vector3 row_views::ray(const lens& glass, const camera_view& view, double x, double row) {
  const double focal = glass.focal_px * view.zoom;
  return turned_vector(view.attitude,
                       {(x - (glass.width - 1) / 2.0) / focal, (row - (glass.height - 1) / 2.0) / focal, 1});
}

std::optional<point2> row_views::project(const vector3& world) const {
  const double focal = lens_.focal_px * middle_.zoom;
  point2 found{0, (lens_.height - 1) / 2.0};
  // Which row sees the point depends on the view, and the view on the row: twice is enough for a few milliseconds.
  for (int pass = 0; pass < (lens_.readout_s == 0 ? 1 : 3); ++pass) {
    const camera_view view = at_row(found.y);
    const vector3 seen =
        turned_back(view.attitude, {world.x - view.position.x, world.y - view.position.y, world.z - view.position.z});
    if (seen.z < nearest_m)
      return std::nullopt;
    found = {(lens_.width - 1) / 2.0 + focal * seen.x / seen.z, (lens_.height - 1) / 2.0 + focal * seen.y / seen.z};
  }
  return found;
}

} // namespace godwit::sim::camera
