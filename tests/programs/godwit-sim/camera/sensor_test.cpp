#include "programs/godwit-sim/camera/sensor.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace godwit::sim::camera {
namespace sensor_test {

canvas even(int brightness) {
  canvas made(256, 128);
  std::ranges::fill(made.pixels, static_cast<std::uint8_t>(brightness));
  return made;
}

double mean_of(const canvas& of) {
  double sum = 0;
  for (const auto each : of.pixels)
    sum += each;
  return sum / static_cast<double>(of.pixels.size());
}

TEST(camera_sensor, noise_has_its_deviation_and_no_mean) {
  auto picture = even(120);
  sensor_settings settings;
  settings.noise = 4;
  expose(picture, settings, 1, 0.5);
  double squares = 0;
  for (const auto each : picture.pixels)
    squares += (each - 120.0) * (each - 120.0);
  EXPECT_NEAR(mean_of(picture), 120, 0.2);
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(picture.pixels.size())), 4, 0.3);
}

TEST(camera_sensor, another_moment_has_another_noise_and_the_same_one_the_same) {
  auto first = even(100);
  auto second = even(100);
  auto again = even(100);
  const sensor_settings settings;
  expose(first, settings, 1, 0.5);
  expose(second, settings, 1, 0.6);
  expose(again, settings, 1, 0.5);
  EXPECT_NE(first.pixels, second.pixels);
  EXPECT_EQ(first.pixels, again.pixels);
}

TEST(camera_sensor, an_exposure_step_comes_at_once_and_goes_slowly) {
  sensor_settings settings;
  settings.noise = 0;
  settings.steps = {{1.0, 1.25}};
  const auto brightness_at = [&](double time_s) {
    auto picture = even(100);
    expose(picture, settings, 1, time_s);
    return mean_of(picture);
  };
  EXPECT_NEAR(brightness_at(0.99), 100, 1);
  EXPECT_NEAR(brightness_at(1.0), 125, 1);
  EXPECT_NEAR(brightness_at(3.0), 100, 1);
}

TEST(camera_sensor, compression_loses_little_at_a_high_quality_and_more_at_a_low_one) {
  const auto loss_at = [](int quality) {
    canvas picture(64, 64);
    for (std::size_t n = 0; n < picture.pixels.size(); ++n)
      picture.pixels[n] = static_cast<std::uint8_t>(100 + 40 * std::sin(static_cast<double>(n) * 0.37));
    const auto before = picture.pixels;
    compress(picture, quality);
    double squares = 0;
    for (std::size_t n = 0; n < before.size(); ++n)
      squares += std::pow(static_cast<double>(before[n]) - picture.pixels[n], 2);
    return std::sqrt(squares / static_cast<double>(before.size()));
  };
  EXPECT_LT(loss_at(98), 2);
  EXPECT_GT(loss_at(20), loss_at(98));
}

TEST(camera_sensor, defocus_takes_the_edges_and_leaves_the_brightness) {
  canvas picture(64, 64);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x)
      picture.pixels[picture.index(x, y)] = x % 2 == 0 ? 80 : 120;
  sensor_settings settings;
  settings.noise = 0;
  settings.defocus_px = 3;
  expose(picture, settings, 1, 0);
  EXPECT_NEAR(mean_of(picture), 100, 3);
  EXPECT_LT(std::abs(picture.pixels[picture.index(30, 30)] - picture.pixels[picture.index(31, 30)]), 8);
}

} // namespace sensor_test
} // namespace godwit::sim::camera
