#include "programs/godwit-sim/camera/texture.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "programs/godwit-sim/camera/random.hpp"

namespace godwit::sim::camera {

namespace {

constexpr int coarsest = 8; // cells of the first octave along a side
constexpr double mean_brightness = 115;

std::size_t index(int row, int column, int side) {
  return static_cast<std::size_t>((row & (side - 1)) * side + (column & (side - 1)));
}

// Twice the size; weights 3/4 and 1/4 (Chaikin), which give no lattice that the eye sees.
std::vector<float> doubled(const std::vector<float>& from, int side) {
  std::vector<float> wide(from.size() * 2);
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column) {
      const float here = from[index(row, column, side)];
      const auto at = static_cast<std::size_t>(row * side * 2 + column * 2);
      wide[at] = 0.75F * here + 0.25F * from[index(row, column - 1, side)];
      wide[at + 1] = 0.75F * here + 0.25F * from[index(row, column + 1, side)];
    }
  std::vector<float> result(from.size() * 4);
  const int width = side * 2;
  for (int row = 0; row < side; ++row) {
    const float* const here = &wide[static_cast<std::size_t>(row * width)];
    const float* const above = &wide[static_cast<std::size_t>(((row - 1) & (side - 1)) * width)];
    const float* const below = &wide[static_cast<std::size_t>(((row + 1) & (side - 1)) * width)];
    float* const out = &result[static_cast<std::size_t>(row * 2 * width)];
    for (int column = 0; column < width; ++column) {
      out[column] = 0.75F * here[column] + 0.25F * above[column];
      out[column + width] = 0.75F * here[column] + 0.25F * below[column];
    }
  }
  return result;
}

// A rectangle in any direction, over the seam where need be.
void paint_patch(std::vector<float>& ground, int side, random_source& random) {
  const bool is_road = random.uniform() < 0.25;
  const double length = side * (is_road ? random.between(0.3, 0.9) : random.between(0.01, 0.15));
  const double width = is_road ? side * random.between(0.015, 0.05) : side * random.between(0.01, 0.15);
  const double angle = random.between(0, std::numbers::pi);
  const double centre_u = random.between(0, side);
  const double centre_v = random.between(0, side);
  const auto shade = static_cast<float>(random.between(-2.2, 2.2));
  const auto share = static_cast<float>(random.between(0.3, 0.9));
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const int reach = static_cast<int>(std::min(std::hypot(length, width) / 2 + 1, side / 2.0 - 1));
  for (int dv = -reach; dv <= reach; ++dv)
    for (int du = -reach; du <= reach; ++du) {
      if (std::abs(du * c + dv * s) > length / 2 || std::abs(dv * c - du * s) > width / 2)
        continue;
      float& at = ground[index(static_cast<int>(centre_v) + dv, static_cast<int>(centre_u) + du, side)];
      at += (shade - at) * share;
    }
}

void add_octave(std::vector<float>& ground, double amplitude, random_source& random) {
  for (float& each : ground)
    each += static_cast<float>(amplitude * (random.uniform() * 2 - 1));
}

// Mean 0 and standard deviation 1.
void normalise(std::vector<float>& values) {
  double sum = 0;
  double squares = 0;
  for (const float each : values) {
    sum += each;
    squares += static_cast<double>(each) * each;
  }
  const double mean = sum / static_cast<double>(values.size());
  const double deviation = std::sqrt(std::max(squares / static_cast<double>(values.size()) - mean * mean, 1e-9));
  for (float& each : values)
    each = static_cast<float>((each - mean) / deviation);
}

std::vector<float> ground_of(std::uint64_t seed, const ground_style& style) {
  random_source random(seed);
  std::vector<float> ground(coarsest * coarsest);
  double amplitude = 1;
  add_octave(ground, amplitude, random);
  int side = coarsest;
  while (side < texture::side) {
    ground = doubled(ground, side);
    side *= 2;
    if (side == texture::side / 4) { // edges finer than the patches' grid are blurred by the last two steps
      normalise(ground);
      for (int n = 0; n < style.patches; ++n)
        paint_patch(ground, side, random);
      amplitude = std::max(amplitude, 0.3);
    }
    amplitude *= style.roughness;
    add_octave(ground, amplitude, random);
  }
  normalise(ground);
  return ground;
}

std::vector<std::uint8_t> halved(const std::vector<std::uint8_t>& from, int side) {
  const int half = side / 2;
  std::vector<std::uint8_t> result(static_cast<std::size_t>(half * half));
  for (int row = 0; row < half; ++row)
    for (int column = 0; column < half; ++column) {
      const auto at = static_cast<std::size_t>(row * 2 * side + column * 2);
      const auto below = at + static_cast<std::size_t>(side);
      result[static_cast<std::size_t>(row * half + column)] =
          static_cast<std::uint8_t>((from[at] + from[at + 1] + from[below] + from[below + 1] + 2) / 4);
    }
  return result;
}

} // namespace

texture::texture(std::uint64_t seed, const ground_style& style) {
  const auto ground = ground_of(seed, style);
  std::vector<std::uint8_t> full(ground.size());
  std::ranges::transform(ground, full.begin(), [&](float value) {
    return static_cast<std::uint8_t>(std::clamp(mean_brightness + style.contrast * value, 5.0, 250.0));
  });
  levels_.push_back(std::move(full));
  for (int n = 1; n < levels; ++n)
    levels_.push_back(halved(levels_.back(), side >> (n - 1)));
}

smooth_field::smooth_field(std::uint64_t seed, double cell_m) : cell_m_(cell_m) {
  random_source random(seed);
  std::vector<float> coarse(side / 4 * (side / 4));
  add_octave(coarse, 1, random);
  values_ = doubled(doubled(coarse, side / 4), side / 2);
  normalise(values_);
}

double smooth_field::at(double north_m, double east_m) const {
  const double v = north_m / cell_m_;
  const double u = east_m / cell_m_;
  const double row = std::floor(v);
  const double column = std::floor(u);
  const double y = v - row;
  const double x = u - column;
  const int r = static_cast<int>(row);
  const int c = static_cast<int>(column);
  const double above = values_[index(r, c, side)] * (1 - x) + values_[index(r, c + 1, side)] * x;
  const double below = values_[index(r + 1, c, side)] * (1 - x) + values_[index(r + 1, c + 1, side)] * x;
  return above * (1 - y) + below * y;
}

} // namespace godwit::sim::camera
