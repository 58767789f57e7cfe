#include "programs/godwit-eyes/detection/parallax.hpp"

#include <gtest/gtest.h>

#include "tests/support/eyes/pose_of_view.hpp"

namespace godwit::eyes {
namespace parallax_test {

// The camera looks straight down and flies to the north, which is up in the picture.
struct flight {
  sim::camera::lens glass{.width = 640, .height = 360, .focal_px = 500, .readout_s = 0};
  sim::camera::camera_view view;
  flight() {
    view.position = {0, 0, -60};
    view.velocity = {6, 0, 0};
    view.attitude = sim::camera::rotation_of(0, 0, 0);
  }
  [[nodiscard]] bool is_like(const Eigen::Vector2d& place, const Eigen::Vector2d& velocity) const {
    const sight from(test::parameters_of(glass), test::pose_of(view, 0), 0, 640);
    return is_like_parallax(from, {6, 0, 0}, place, velocity);
  }
};

TEST(parallax, a_treetop_goes_down_the_picture_when_the_camera_flies_up_it) {
  const flight with;
  // A top at 8 m: 500 / 52 * 6 instead of 500 / 60 * 6 pixels a second, so 7.7 faster than the ground.
  EXPECT_TRUE(with.is_like({320, 180}, {0, 7.7}));
}

TEST(parallax, what_goes_against_it_across_it_or_faster_than_anything_high_is_none) {
  const flight with;
  EXPECT_FALSE(with.is_like({320, 180}, {0, -15}));
  EXPECT_FALSE(with.is_like({320, 180}, {20, 5}));
  EXPECT_FALSE(with.is_like({320, 180}, {0, 40}));
}

TEST(parallax, a_camera_that_stands_sees_none) {
  const flight with;
  const sight from(test::parameters_of(with.glass), test::pose_of(with.view, 0), 0, 640);
  EXPECT_FALSE(is_like_parallax(from, {0, 0, 0}, {320, 180}, {0, 7}));
}

} // namespace parallax_test
} // namespace godwit::eyes
