#include "actors/movement_detector/camera_attitude.hpp"

#include <numbers>

#include <gtest/gtest.h>

namespace camera_attitude_test {

using namespace godwit::movement_detector;

constexpr double quarter = std::numbers::pi / 2;

void expect_near(const std::array<double, 3>& is, const std::array<double, 3>& wanted) {
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(is.at(i), wanted.at(i), 1e-12) << i;
}

TEST(camera_attitude, a_level_camera_looks_ahead_with_its_right_to_the_right) {
  const auto mount = mount_of(0, 0, 0);
  expect_near(turned(mount, {0, 0, 1}), {1, 0, 0});
  expect_near(turned(mount, {1, 0, 0}), {0, 1, 0});
  expect_near(turned(mount, {0, 1, 0}), {0, 0, 1});
}

TEST(camera_attitude, one_that_is_turned_down_sees_the_ground_with_ahead_at_its_upper_edge) {
  const auto mount = mount_of(0, -quarter, 0);
  expect_near(turned(mount, {0, 0, 1}), {0, 0, 1});
  expect_near(turned(mount, {0, -1, 0}), {1, 0, 0});
  expect_near(turned(mount, {1, 0, 0}), {0, 1, 0});
}

TEST(camera_attitude, the_vehicle_turns_its_camera) {
  // The nose to the east, then the right wing down.
  const auto nadir = from_angles(0, 0, quarter) * mount_of(0, -quarter, 0);
  expect_near(turned(nadir, {0, -1, 0}), {0, 1, 0});
  const auto banked = from_angles(quarter, 0, 0) * mount_of(0, -quarter, 0);
  expect_near(turned(banked, {0, 0, 1}), {0, -1, 0});
}

TEST(camera_attitude, an_inverse_takes_it_back) {
  const auto any = from_angles(0.3, -0.4, 2.0);
  expect_near(turned(inverse(any), turned(any, {1, 2, 3})), {1, 2, 3});
}

} // namespace camera_attitude_test
