#include "programs/godwit-sim/camera/shape_painter.hpp"

#include <numbers>

#include "programs/godwit-sim/camera/random.hpp"

namespace godwit::sim::camera {

namespace {

constexpr double shade_of_shadow = 0.6;
constexpr int crown_corners = 12;
constexpr double farthest_px = 20000; // a corner farther out is not in any picture

struct painter {
  canvas& on;
  const scene& world;
  const row_views& views;
  std::vector<int>& painted;
};

// Nothing: a corner lies behind the camera.
std::vector<point2> projected(const row_views& views, std::span<const vector3> corners) {
  std::vector<point2> result;
  for (const auto& each : corners) {
    const auto at = views.project(each);
    if (!at || std::abs(at->x) > farthest_px || std::abs(at->y) > farthest_px)
      return {};
    result.push_back(*at);
  }
  return result;
}

bool is_left_turn(const point2& a, const point2& b, const point2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) > 0;
}

// Monotone chain (Andrew 1979).
std::vector<point2> convex_hull(std::vector<point2> points) {
  std::ranges::sort(points, [](const point2& a, const point2& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  std::vector<point2> hull;
  const auto add = [&](const point2& next, std::size_t keep) {
    while (hull.size() > keep && !is_left_turn(hull[hull.size() - 2], hull.back(), next))
      hull.pop_back();
    hull.push_back(next);
  };
  for (const auto& each : points)
    add(each, 1);
  const std::size_t lower = hull.size();
  for (auto each = points.rbegin() + 1; each != points.rend(); ++each)
    add(*each, lower);
  hull.pop_back();
  return hull;
}

// On the ground, at the ground's height there.
vector3 on_ground(const scene& world, double north, double east) { return {north, east, world.ground_z(north, east)}; }

void paint_shadow(const painter& with, const std::vector<vector3>& outline) {
  auto seen = projected(with.views, outline);
  if (seen.size() < 3)
    return;
  seen = convex_hull(std::move(seen));
  fill_convex(with.on, seen,
              [](int, int, std::uint8_t& pixel, double share) { blend(pixel, pixel * shade_of_shadow, share); });
}

void paint_shadow(const painter& with, const box_shape& box) {
  const point2 shift = with.world.shadow_of_metre();
  std::vector<vector3> outline;
  const auto corners = corners_of(box);
  for (std::size_t n = 0; n < 4; ++n) {
    outline.push_back(corners[n]);
    outline.push_back(
        on_ground(with.world, corners[n].x + shift.x * box.height_m, corners[n].y + shift.y * box.height_m));
  }
  paint_shadow(with, outline);
}

void paint_shadow(const painter& with, const crown_shape& crown) {
  const point2 shift = with.world.shadow_of_metre();
  const double height = crown.base_z - crown.centre.z;
  std::vector<vector3> outline;
  for (int n = 0; n < crown_corners; ++n) {
    const double angle = 2 * std::numbers::pi * n / crown_corners;
    outline.push_back(on_ground(with.world, crown.centre.x + shift.x * height + crown.radius_m * std::cos(angle),
                                crown.centre.y + shift.y * height + crown.radius_m * std::sin(angle)));
  }
  paint_shadow(with, outline);
}

// A mover is made of parts: bonnet, windows, load, or head and shoulders. S and T: 0 to 1 along the two edges.
double part_contrast(std::uint32_t pattern, double s, double t) {
  const auto cell = static_cast<std::uint64_t>(std::clamp(static_cast<int>(s * 5), 0, 4) * 2 +
                                               std::clamp(static_cast<int>(t * 2), 0, 1));
  return static_cast<double>(scrambled(pattern + cell * 977) % 81) - 40;
}

// One flat side with the texture of the ground on it; the first three corners say how it lies.
struct side_paint {
  double shade = 1;
  double first_m = 1;  // length from corner 0 to 1
  double second_m = 1; // from corner 1 to 2
};

void paint_side(const painter& with, const box_shape& box, std::span<const vector3> corners, const side_paint& how) {
  const auto seen = projected(with.views, corners);
  if (seen.size() < 3)
    return;
  const point2 e{seen[1].x - seen[0].x, seen[1].y - seen[0].y};
  const point2 f{seen[2].x - seen[1].x, seen[2].y - seen[1].y};
  const double area = e.x * f.y - e.y * f.x;
  if (std::abs(area) < 1e-3)
    return;
  const int u0 = static_cast<int>(box.pattern & 1023U);
  const int v0 = static_cast<int>((box.pattern >> 10U) & 1023U);
  fill_convex(with.on, seen, [&](int x, int y, std::uint8_t& pixel, double share) {
    const double dx = x - seen[0].x;
    const double dy = y - seen[0].y;
    const double s = (dx * f.y - dy * f.x) / area;
    const double t = (dy * e.x - dx * e.y) / area;
    const int grain = with.world.ground().at(u0 + static_cast<int>(s * how.first_m / texture::texel_m),
                                             v0 + static_cast<int>(t * how.second_m / texture::texel_m));
    double value = box.brightness * how.shade + (grain - 115) * 0.5;
    if (box.mover != 0)
      value += part_contrast(box.pattern, s, t);
    blend(pixel, value, share);
    std::uint8_t& owner = with.on.owner[with.on.index(x, y)];
    if (share > 0.5 && owner != box.mover) {
      owner = static_cast<std::uint8_t>(box.mover);
      ++with.painted[box.mover];
    }
  });
}

void paint_box(const painter& with, const box_shape& box) {
  const auto c = corners_of(box);
  const vector3& eye = with.views.middle().position;
  for (std::size_t n = 0; n < 4; ++n) {
    const vector3& a = c[n];
    const vector3& b = c[(n + 1) % 4];
    // The outer side is to the left of the way around.
    const double outside = (b.y - a.y) * (eye.x - a.x) - (b.x - a.x) * (eye.y - a.y);
    if (outside <= 0)
      continue;
    const std::array<vector3, 4> side{a, b, c[4 + (n + 1) % 4], c[4 + n]};
    paint_side(with, box, side, {n % 2 == 0 ? 0.75 : 0.6, n % 2 == 0 ? box.length_m : box.width_m, box.height_m});
  }
  const std::array<vector3, 4> top{c[4], c[5], c[6], c[7]};
  paint_side(with, box, top, {1, box.length_m, box.width_m});
}

void paint_crown(const painter& with, const crown_shape& crown) {
  const auto middle = with.views.project(crown.centre);
  const vector3& eye = with.views.middle().position;
  const double distance = std::hypot(crown.centre.x - eye.x, crown.centre.y - eye.y, crown.centre.z - eye.z);
  const double radius = crown.radius_m * with.views.glass().focal_px * with.views.middle().zoom / distance;
  if (!middle || std::abs(middle->x) > farthest_px || std::abs(middle->y) > farthest_px || radius > 1000)
    return;
  const std::array<point2, 2> box{point2{middle->x - radius, middle->y - radius},
                                  point2{middle->x + radius, middle->y + radius}};
  const pixel_range range = range_of(with.on, box);
  const double texels = crown.radius_m / texture::texel_m / radius;
  const int u0 = static_cast<int>(crown.pattern & 1023U);
  const int v0 = static_cast<int>((crown.pattern >> 10U) & 1023U);
  for (int y = range.top; y <= range.bottom; ++y)
    for (int x = range.left; x <= range.right; ++x) {
      const double dx = (x - middle->x) / radius;
      const double dy = (y - middle->y) / radius;
      const double out = dx * dx + dy * dy;
      if (out > 1)
        continue;
      const int grain = with.world.ground().at(u0 + static_cast<int>((x - middle->x) * texels),
                                               v0 + static_cast<int>((y - middle->y) * texels)) -
                        115;
      const double share = std::clamp((1 - out) * 4 + grain * 0.02, 0.0, 1.0);
      if (share <= 0)
        continue;
      blend(with.on.pixels[with.on.index(x, y)], crown.brightness * (1 - 0.3 * dx) + grain * 1.5, share);
      if (share > 0.5)
        with.on.owner[with.on.index(x, y)] = 0;
    }
}

void paint_glint(canvas& on, const row_views& views, const glint_shape& glint) {
  const auto at = views.project(glint.at);
  if (!at || std::abs(at->x) > farthest_px || std::abs(at->y) > farthest_px)
    return;
  const double reach = 3 * glint.radius_px;
  const std::array<point2, 2> box{point2{at->x - reach, at->y - reach}, point2{at->x + reach, at->y + reach}};
  const pixel_range range = range_of(on, box);
  for (int y = range.top; y <= range.bottom; ++y)
    for (int x = range.left; x <= range.right; ++x) {
      const double d = std::hypot(x - at->x, y - at->y) / glint.radius_px;
      blend(on.pixels[on.index(x, y)], 255, std::exp(-d * d));
    }
}

double distance_to(const row_views& views, double north, double east, double down) {
  const vector3& eye = views.middle().position;
  return std::hypot(north - eye.x, east - eye.y, down - eye.z);
}

} // namespace

pixel_range range_of(const canvas& on, std::span<const point2> polygon) {
  double left = farthest_px;
  double right = -farthest_px;
  double top = farthest_px;
  double bottom = -farthest_px;
  for (const auto& each : polygon) {
    left = std::min(left, each.x);
    right = std::max(right, each.x);
    top = std::min(top, each.y);
    bottom = std::max(bottom, each.y);
  }
  return {std::max(0, static_cast<int>(std::floor(left - 1))), std::max(0, static_cast<int>(std::floor(top - 1))),
          std::min(on.width - 1, static_cast<int>(std::ceil(right + 1))),
          std::min(on.height - 1, static_cast<int>(std::ceil(bottom + 1)))};
}

std::array<vector3, 8> corners_of(const box_shape& box) {
  const double c = std::cos(box.heading_rad);
  const double s = std::sin(box.heading_rad);
  std::array<vector3, 8> corners;
  const double along[] = {-0.5, 0.5, 0.5, -0.5};
  const double across[] = {-0.5, -0.5, 0.5, 0.5};
  for (std::size_t n = 0; n < 4; ++n) {
    const double l = along[n] * box.length_m;
    const double w = across[n] * box.width_m;
    corners[n] = {box.centre.x + l * c - w * s, box.centre.y + l * s + w * c, box.base_z};
    corners[n + 4] = {corners[n].x, corners[n].y, box.base_z - box.height_m};
  }
  return corners;
}

void paint_shapes(canvas& on, const scene& world, const shapes& what, const row_views& views,
                  std::vector<int>& painted_by_mover) {
  const painter with{on, world, views, painted_by_mover};
  if (world.settings().has_shadows) {
    for (const auto& each : what.boxes)
      paint_shadow(with, each);
    for (const auto& each : what.crowns)
      paint_shadow(with, each);
  }
  struct order {
    double distance;
    const box_shape* box;
    const crown_shape* crown;
  };
  std::vector<order> all;
  for (const auto& each : what.boxes)
    all.push_back({distance_to(views, each.centre.x, each.centre.y, each.base_z - each.height_m), &each, nullptr});
  for (const auto& each : what.crowns)
    all.push_back({distance_to(views, each.centre.x, each.centre.y, each.centre.z), nullptr, &each});
  std::ranges::stable_sort(all, [](const order& a, const order& b) { return a.distance > b.distance; });
  for (const auto& each : all)
    if (each.box != nullptr)
      paint_box(with, *each.box);
    else
      paint_crown(with, *each.crown);
  for (const auto& each : what.glints)
    paint_glint(on, views, each);
}

} // namespace godwit::sim::camera
