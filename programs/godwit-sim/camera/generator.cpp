#include "programs/godwit-sim/camera/generator.hpp"

#include <utility>

#include <GeographicLib/LocalCartesian.hpp>
#include <nlohmann/json.hpp>

#include "programs/godwit-sim/camera/ground_painter.hpp"
#include "programs/godwit-sim/camera/sensor.hpp"
#include "programs/godwit-sim/camera/shape_painter.hpp"

namespace godwit::sim::camera {

namespace {

constexpr double least_reach_m = 60;
constexpr double reach_by_height = 4;

scene_settings bounded(scene_settings settings) {
  if (settings.movers.size() > generator::max_movers)
    settings.movers.resize(generator::max_movers);
  return settings;
}

// The part of a box inside of the picture; nothing: it is not in it.
std::optional<true_mover> seen_of(const box_shape& box, const row_views& views) {
  double left = 1e9;
  double right = -1e9;
  double top = 1e9;
  double bottom = -1e9;
  for (const auto& corner : corners_of(box)) {
    const auto at = views.project(corner);
    if (!at)
      return std::nullopt;
    left = std::min(left, at->x);
    right = std::max(right, at->x);
    top = std::min(top, at->y);
    bottom = std::max(bottom, at->y);
  }
  // A pixel's area reaches half a pixel around its middle.
  const double last_x = views.glass().width - 0.5;
  const double last_y = views.glass().height - 0.5;
  if (right < -0.5 || bottom < -0.5 || left > last_x || top > last_y)
    return std::nullopt;
  true_mover seen;
  seen.is_cut = left < -0.5 || top < -0.5 || right > last_x || bottom > last_y;
  left = std::max(left, -0.5);
  top = std::max(top, -0.5);
  seen.x_px = left + 0.5;
  seen.y_px = top + 0.5;
  seen.width_px = std::min(right, last_x) - left;
  seen.height_px = std::min(bottom, last_y) - top;
  return seen;
}

double speed_in_pixels(const box_shape& box, double speed_m_s, const row_views& views) {
  constexpr double step_s = 0.01;
  const auto here = views.project({box.centre.x, box.centre.y, box.base_z});
  const double way = speed_m_s * step_s;
  const auto there = views.project(
      {box.centre.x + way * std::cos(box.heading_rad), box.centre.y + way * std::sin(box.heading_rad), box.base_z});
  return here && there ? std::hypot(there->x - here->x, there->y - here->y) / step_s : 0;
}

} // namespace

generator::generator(scene_settings settings, const lens& glass) : scene_(bounded(std::move(settings))), lens_(glass) {}

shot generator::take(const camera_view& view) const {
  canvas on(lens_.width, lens_.height);
  const row_views views(lens_, view);
  paint_ground(on, scene_, views);

  // Around the place that the middle of the picture shows.
  const double height = std::max(1.0, -view.position.z);
  const auto middle = ground_at(scene_, views, lens_.width / 2.0, lens_.height / 2.0);
  const point2 centre = middle ? point2{middle->x, middle->y} : point2{view.position.x, view.position.y};
  const auto what = scene_.around(centre, std::max(least_reach_m, reach_by_height * height), view.time_s);
  std::vector<int> painted(scene_.settings().movers.size() + 1);
  paint_shapes(on, scene_, what, views, painted);

  std::vector<int> left(painted.size());
  for (const std::uint8_t owner : on.owner)
    ++left[owner];
  shot taken;
  taken.real.time_s = view.time_s;
  taken.real.view = view;
  for (const auto& box : what.boxes) {
    if (box.mover == 0)
      continue;
    auto seen = seen_of(box, views);
    if (!seen)
      continue;
    const mover& who = scene_.settings().movers[box.mover - 1];
    seen->id = who.id;
    seen->kind = who.kind;
    seen->visible_share = painted[box.mover] == 0 ? 0 : static_cast<double>(left[box.mover]) / painted[box.mover];
    seen->north_m = box.centre.x;
    seen->east_m = box.centre.y;
    seen->speed_m_s = place_of(who, view.time_s).speed_m_s;
    seen->speed_px_s = speed_in_pixels(box, seen->speed_m_s, views);
    taken.real.movers.push_back(*std::move(seen));
  }

  expose(on, scene_.settings().sensor, scene_.settings().seed, view.time_s);
  if (scene_.settings().sensor.jpeg_quality > 0)
    compress(on, scene_.settings().sensor.jpeg_quality);
  taken.seen = {lens_.width, lens_.height, std::move(on.pixels)};
  return taken;
}

std::vector<std::uint8_t> bgr_of(const picture& grey) {
  std::vector<std::uint8_t> result;
  result.reserve(grey.grey.size() * 3);
  for (const std::uint8_t value : grey.grey) {
    result.push_back(static_cast<std::uint8_t>(value * 200 / 256));
    result.push_back(value);
    result.push_back(static_cast<std::uint8_t>(std::min(255, value * 230 / 256 + 10)));
  }
  return result;
}

void place_on_earth(truth& what, double origin_latitude_deg, double origin_longitude_deg) {
  const GeographicLib::LocalCartesian frame(origin_latitude_deg, origin_longitude_deg);
  for (auto& each : what.movers) {
    double height = 0;
    frame.Reverse(each.east_m, each.north_m, 0, each.latitude_deg, each.longitude_deg, height);
  }
}

std::string json_line(const truth& what) {
  auto movers = nlohmann::json::array();
  for (const auto& each : what.movers)
    movers.push_back({{"id", each.id},
                      {"kind", each.kind},
                      {"x_px", each.x_px},
                      {"y_px", each.y_px},
                      {"width_px", each.width_px},
                      {"height_px", each.height_px},
                      {"visible_share", each.visible_share},
                      {"is_cut", each.is_cut},
                      {"north_m", each.north_m},
                      {"east_m", each.east_m},
                      {"latitude_deg", each.latitude_deg},
                      {"longitude_deg", each.longitude_deg},
                      {"speed_m_s", each.speed_m_s},
                      {"speed_px_s", each.speed_px_s}});
  const auto q = quaternion_of(what.view.attitude);
  const auto& at = what.view.position;
  const nlohmann::json line{
      {"time_s", what.time_s},
      {"camera",
       {{"north_m", at.x}, {"east_m", at.y}, {"down_m", at.z}, {"attitude_wxyz", q}, {"zoom", what.view.zoom}}},
      {"movers", movers}};
  return line.dump() + "\n";
}

} // namespace godwit::sim::camera
