#include "programs/godwit-sim/camera/ground_painter.hpp"

#include <optional>

namespace godwit::sim::camera {

namespace {

constexpr int block = 8;
constexpr int sky = 205;
constexpr double least_slope = 0.05; // of a ray below the horizontal
constexpr int relief_passes = 4;     // of the search for the ground; slopes are below 30 %

struct corner {
  bool is_ground = false;
  double u = 0; // texels of level 0
  double v = 0;
  double offset = 0; // added to the texture
  double gain = 1;   // sunlight
};

corner corner_at(const scene& world, const row_views& views, double x, double y) {
  const auto hit = ground_at(world, views, x, y);
  if (!hit)
    return {};
  return {true, hit->y / texture::texel_m, hit->x / texture::texel_m, 14 * world.large_areas(hit->x, hit->y),
          world.sunlight(hit->x, hit->y, views.middle().time_s)};
}

// 16.16; wraps as the texture does.
std::uint32_t fixed(double texels) {
  return static_cast<std::uint32_t>(static_cast<std::int64_t>(std::floor(texels * 65536)));
}

// Brightness at a place of one level, times 256.
inline int sampled(const std::uint8_t* texels, int bits, std::uint32_t u, std::uint32_t v) {
  const std::uint32_t mask = (1U << static_cast<unsigned>(bits)) - 1;
  const std::uint32_t column = (u >> 16U) & mask;
  const std::uint32_t row = ((v >> 16U) & mask) << static_cast<unsigned>(bits);
  const std::uint32_t next_column = (column + 1) & mask;
  const std::uint32_t next_row = (row + mask + 1) & ((mask + 1) * (mask + 1) - 1);
  const int x = static_cast<int>((u >> 8U) & 255U);
  const int y = static_cast<int>((v >> 8U) & 255U);
  const int above = texels[row + column] * (256 - x) + texels[row + next_column] * x;
  const int below = texels[next_row + column] * (256 - x) + texels[next_row + next_column] * x;
  return (above * (256 - y) + below * y) >> 8;
}

struct block_corners {
  corner upper_left, upper_right, lower_left, lower_right;
};

struct detail {
  int level = 0;
  int share_of_next = 0; // 0..256 of the coarser one
};

// So that one texel is about one pixel.
detail detail_of(const block_corners& c) {
  const double du = c.upper_right.u - c.upper_left.u;
  const double dv = c.upper_right.v - c.upper_left.v;
  const double eu = c.lower_left.u - c.upper_left.u;
  const double ev = c.lower_left.v - c.upper_left.v;
  const double texels_a_pixel = std::sqrt(std::abs(du * ev - dv * eu)) / block;
  const double level = std::clamp(std::log2(std::max(texels_a_pixel, 1e-6)), 0.0, texture::levels - 1.001);
  return {static_cast<int>(level), static_cast<int>((level - std::floor(level)) * 256)};
}

struct block_place {
  int left, top, right, bottom; // right and bottom: after the last one
};

double mixed(double a, double b, double share) { return a + (b - a) * share; }

corner mixed(const corner& a, const corner& b, double share) {
  return {true, mixed(a.u, b.u, share), mixed(a.v, b.v, share), mixed(a.offset, b.offset, share),
          mixed(a.gain, b.gain, share)};
}

// From the middles of texels of level 0 to those of LEVEL.
std::uint32_t at_level(double texels, int level) { return fixed((texels) / (1 << level) - 0.5); }

void paint_row(std::uint8_t* out, int count, const texture& ground, const corner& left, const corner& right,
               const detail& how) {
  const std::uint8_t* const fine = ground.level(how.level);
  const std::uint8_t* const coarse = ground.level(how.level + 1);
  const int bits = texture::side_bits - how.level;
  std::uint32_t u = at_level(left.u, how.level);
  std::uint32_t v = at_level(left.v, how.level);
  const std::uint32_t du = fixed((right.u - left.u) / block / (1 << how.level));
  const std::uint32_t dv = fixed((right.v - left.v) / block / (1 << how.level));
  int gain = static_cast<int>(left.gain * 256);
  const int gain_step = static_cast<int>((right.gain - left.gain) * 256 / block);
  int offset = static_cast<int>(left.offset * 65536);
  const int offset_step = static_cast<int>((right.offset - left.offset) * 65536 / block);
  for (int x = 0; x < count; ++x) {
    int value = sampled(fine, bits, u, v);
    if (how.share_of_next > 16) {
      const std::uint32_t shift = 0x4000U; // (u + 0.5) / 2 - 0.5
      const auto half = [&](std::uint32_t w) {
        return static_cast<std::uint32_t>(static_cast<std::int32_t>(w) >> 1) - shift;
      };
      value += ((sampled(coarse, bits - 1, half(u), half(v)) - value) * how.share_of_next) >> 8;
    }
    value = ((value * 256 + offset) >> 8) * gain >> 16;
    out[x] = static_cast<std::uint8_t>(std::clamp(value, 0, 255));
    u += du;
    v += dv;
    gain += gain_step;
    offset += offset_step;
  }
}

void paint_block(canvas& on, const texture& ground, const block_corners& corners, const block_place& where) {
  const bool is_ground = corners.upper_left.is_ground && corners.upper_right.is_ground &&
                         corners.lower_left.is_ground && corners.lower_right.is_ground;
  const detail how = is_ground ? detail_of(corners) : detail{};
  for (int y = where.top; y < where.bottom; ++y) {
    std::uint8_t* const out = &on.pixels[on.index(where.left, y)];
    if (!is_ground) {
      std::fill_n(out, where.right - where.left, static_cast<std::uint8_t>(sky));
      continue;
    }
    const double share = static_cast<double>(y - where.top) / block;
    paint_row(out, where.right - where.left, ground, mixed(corners.upper_left, corners.lower_left, share),
              mixed(corners.upper_right, corners.lower_right, share), how);
  }
}

} // namespace

std::optional<vector3> ground_at(const scene& world, const row_views& views, double x, double y) {
  const camera_view view = views.at_row(y);
  const vector3 ray = row_views::ray(views.glass(), view, x, y);
  if (ray.z < least_slope * std::hypot(ray.x, ray.y))
    return std::nullopt;
  vector3 hit{0, 0, 0};
  const int passes = world.settings().relief_m == 0 ? 1 : relief_passes;
  for (int n = 0; n < passes; ++n) {
    const double along = (hit.z - view.position.z) / ray.z;
    hit.x = view.position.x + along * ray.x;
    hit.y = view.position.y + along * ray.y;
    if (passes > 1)
      hit.z = world.ground_z(hit.x, hit.y);
  }
  return hit;
}

void paint_ground(canvas& on, const scene& world, const row_views& views) {
  const int columns = (on.width + block - 1) / block;
  const auto line = [&](int top) {
    std::vector<corner> corners;
    for (int n = 0; n <= columns; ++n)
      corners.push_back(corner_at(world, views, n * block, top));
    return corners;
  };
  auto above = line(0);
  for (int top = 0; top < on.height; top += block) {
    auto below = line(top + block);
    for (int n = 0; n < columns; ++n) {
      const auto at = static_cast<std::size_t>(n);
      paint_block(on, world.ground(), {above[at], above[at + 1], below[at], below[at + 1]},
                  {n * block, top, std::min((n + 1) * block, on.width), std::min(top + block, on.height)});
    }
    above = std::move(below);
  }
}

} // namespace godwit::sim::camera
