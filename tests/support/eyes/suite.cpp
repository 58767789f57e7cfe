#include "tests/support/eyes/suite.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "programs/godwit-sim/camera/random.hpp"

namespace godwit::sim::camera {

namespace {

constexpr double radian = std::numbers::pi / 180;
constexpr double frames_a_second = 30;
constexpr int ground_brightness = 115;
constexpr int fewest_movers = 5;
constexpr int most_movers = 12;
constexpr double nominal_width = 1280;

// Draws as the rule in the header says.
class lot {
public:
  lot(std::uint64_t seed, std::uint64_t use) : random_(seed_for(seed, use)), is_whole_(is_held_back(seed)) {}

  double from(const range& of) {
    const double share = random_.uniform();
    return of.least + (of.most - of.least) * (is_whole_ ? share : (1 + 4 * share) / 6);
  }
  double angle() { return random_.between(0, 2 * std::numbers::pi); }
  random_source& random() { return random_; }

private:
  random_source random_;
  bool is_whole_;
};

enum use : std::uint64_t { of_flight = 101, of_scene = 102, of_movers = 103 };

scene_settings scene_for(std::uint64_t seed, tier which, const suite_ranges& ranges) {
  lot draw(seed, of_scene);
  scene_settings made = which == tier::a ? tier_a(seed) : tier_b(seed);
  made.style.contrast = draw.from(ranges.contrast);
  made.style.roughness = draw.from(ranges.roughness);
  made.sensor.noise = draw.from(ranges.noise);
  made.sensor.jpeg_quality = draw.random().uniform() < 0.5 ? static_cast<int>(draw.from(ranges.jpeg_quality)) : 0;
  for (double at_s = draw.random().between(0.5, 4); at_s < suite_case::longest_s; at_s += draw.random().between(1.5, 6))
    made.sensor.steps.push_back({at_s, draw.from(ranges.exposure_factor)});
  if (which == tier::b) {
    made.relief_m = draw.from(ranges.relief_m);
    made.buildings_a_cell = draw.from(ranges.buildings_a_cell);
    made.trees_a_cell = draw.from(ranges.trees_a_cell);
    made.glints_a_cell = draw.from(ranges.glints_a_cell);
  }
  return made;
}

// Where a pixel's ray meets the plane of tier A; nothing: too near to the horizon.
std::optional<point2> on_plane(const row_views& views, double x, double y) {
  const vector3& eye = views.middle().position;
  const vector3 ray = row_views::ray(views.glass(), views.middle(), x, y);
  if (ray.z < 0.1 * std::hypot(ray.x, ray.y))
    return std::nullopt;
  return point2{eye.x - eye.z / ray.z * ray.x, eye.y - eye.z / ray.z * ray.y};
}

// Through a random place of the picture at a random moment, so that it is seen.
mover mover_for(std::uint32_t id, lot& draw, const suite_ranges& ranges, const point2& at, double metres_a_pixel,
                double met_at_s) {
  mover made;
  made.id = id;
  made.heading_rad = draw.angle();
  made.turn_rad_s = draw.from(ranges.mover_turn_deg_s) * radian;
  made.speed_m_s = draw.from(ranges.mover_px_a_frame) * frames_a_second * metres_a_pixel;
  made.length_m = draw.from(ranges.mover_px) * metres_a_pixel;
  made.width_m = made.length_m * draw.from(ranges.mover_shape);
  made.height_m = std::clamp(made.width_m * 0.7, 0.4, 2.0);
  made.kind = made.length_m < 1 ? "animal" : "vehicle";
  if (made.length_m < 1.5 && made.speed_m_s < 3) { // as high as people are, and as broad as long
    made.kind = "person";
    made.height_m = 1.7;
  }
  const double contrast = draw.from(ranges.mover_contrast);
  made.brightness = ground_brightness + static_cast<int>(draw.random().uniform() < 0.5 ? contrast : -contrast);
  if (draw.random().uniform() < 0.15)
    made.pause_every_s = draw.random().between(3, 8);
  const auto then = place_of(made, met_at_s).at;
  made.start = {at.x - then.x, at.y - then.y};
  return made;
}

} // namespace

suite_case::suite_case(std::uint64_t seed, tier which, const suite_options& options) {
  const suite_ranges& ranges = options.ranges;
  lot draw(seed, of_flight);
  lens glass;
  glass.width = options.width;
  glass.height = options.height;
  glass.focal_px = options.width / (2 * std::tan(draw.from(ranges.field_of_view_deg) * radian / 2));
  glass.readout_s = draw.from(ranges.readout_s);
  flight_.height_m = draw.from(ranges.height_m);
  flight_.course_rad = draw.angle();
  flight_.speed_m_s = draw.from(ranges.speed_m_s);
  flight_.climb_m_s = draw.from(ranges.climb_m_s);
  flight_.heading_rad = draw.angle();
  flight_.turn_rad_s = (draw.from(ranges.turn_deg_s) + options.pan_deg_s) * radian;
  flight_.off_nadir_rad = draw.from(ranges.off_nadir_deg) * radian;
  flight_.shake_rad = draw.from(ranges.shake_deg) * radian;
  flight_.shake_hz = draw.from(ranges.shake_hz);
  flight_.shake_phase = draw.angle();
  flight_.zoom_a_s = draw.from(ranges.zoom_a_s);

  scene_settings settings = scene_for(seed, which, ranges);
  if (options.has_movers) {
    lot of(seed, of_movers);
    const int count = fewest_movers + of.random().below(most_movers - fewest_movers + 1);
    for (int n = 0; n < count; ++n) {
      const double met_at_s = of.random().between(0, 3.5);
      const row_views views(glass, view_at(met_at_s));
      const double x = of.random().uniform() * options.width;
      const double y = of.random().uniform() * options.height;
      const auto at = on_plane(views, x, y);
      const auto beside = on_plane(views, x + 1, y);
      if (!at || !beside)
        continue;
      const double metres_a_pixel = std::hypot(beside->x - at->x, beside->y - at->y) * options.width / nominal_width;
      settings.movers.push_back(
          mover_for(static_cast<std::uint32_t>(n + 1), of, ranges, *at, metres_a_pixel, met_at_s));
    }
  }
  maker_ = std::make_shared<const generator>(std::move(settings), glass);
}

camera_view suite_case::still_at(double time_s) const {
  const double shake = 2 * std::numbers::pi * flight_.shake_hz * time_s + flight_.shake_phase;
  camera_view view;
  view.time_s = time_s;
  view.position = {flight_.speed_m_s * time_s * std::cos(flight_.course_rad),
                   flight_.speed_m_s * time_s * std::sin(flight_.course_rad),
                   -std::max(flight_.height_m + flight_.climb_m_s * time_s, flight_.height_m / 2)};
  view.attitude = rotation_of(flight_.heading_rad + flight_.turn_rad_s * time_s,
                              flight_.off_nadir_rad + flight_.shake_rad * std::sin(shake),
                              flight_.shake_rad * std::cos(0.73 * shake));
  view.zoom = std::clamp(1 + flight_.zoom_a_s * time_s, 0.7, 1.4);
  return view;
}

camera_view suite_case::view_at(double time_s) const {
  constexpr double step_s = 1e-3;
  camera_view view = still_at(time_s);
  const camera_view before = still_at(time_s - step_s);
  const camera_view after = still_at(time_s + step_s);
  const auto slope = [](double a, double b) { return (b - a) / (2 * step_s); };
  view.velocity = {slope(before.position.x, after.position.x), slope(before.position.y, after.position.y),
                   slope(before.position.z, after.position.z)};
  const vector3 turn = turn_between(before.attitude, after.attitude);
  view.rate = {turn.x / (2 * step_s), turn.y / (2 * step_s), turn.z / (2 * step_s)};
  return view;
}

} // namespace godwit::sim::camera
