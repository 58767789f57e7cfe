#include "programs/godwit-sim/camera/texture.hpp"

#include <cmath>
#include <cstdlib>

#include <gtest/gtest.h>

namespace godwit::sim::camera {
namespace texture_test {

TEST(camera_texture, has_the_contrast_that_was_asked_for) {
  const texture ground(7, {20, 0.7, 40});
  double sum = 0;
  double squares = 0;
  constexpr int count = texture::side * texture::side;
  for (int n = 0; n < count; ++n) {
    const double value = ground.at(n % texture::side, n / texture::side);
    sum += value;
    squares += value * value;
  }
  const double mean = sum / count;
  EXPECT_NEAR(mean, 115, 3);
  EXPECT_NEAR(std::sqrt(squares / count - mean * mean), 20, 2);
}

TEST(camera_texture, has_no_seam) {
  const texture ground(8, {});
  const auto step = [&](int u) {
    double sum = 0;
    for (int v = 0; v < texture::side; ++v)
      sum += std::abs(ground.at(u, v) - ground.at(u + 1, v));
    return sum / texture::side;
  };
  double inside = 0;
  for (int u = 100; u < 200; ++u)
    inside += step(u) / 100;
  EXPECT_LT(step(texture::side - 1), 2 * inside + 1);
}

TEST(camera_texture, a_smooth_field_repeats_and_has_deviation_1) {
  const smooth_field field(3, 2.0);
  double squares = 0;
  for (int n = 0; n < 4096; ++n) {
    const double value = field.at(n % 64 * 2.0, n / 64 * 2.0);
    squares += value * value / 4096;
    EXPECT_NEAR(value, field.at(n % 64 * 2.0 + 128, n / 64 * 2.0 - 128), 1e-9);
  }
  EXPECT_NEAR(squares, 1, 0.05);
}

} // namespace texture_test
} // namespace godwit::sim::camera
