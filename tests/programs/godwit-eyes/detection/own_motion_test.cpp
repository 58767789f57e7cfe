#include "programs/godwit-eyes/detection/own_motion.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "programs/godwit-eyes/detection/picture_check.hpp"
#include "programs/godwit-sim/camera/ground_painter.hpp"
#include "tests/support/eyes/suite.hpp"

namespace godwit::eyes {
namespace own_motion_test {

using sim::camera::suite_case;

cv::Mat mat_of(const sim::camera::picture& seen) {
  cv::Mat made(seen.height, seen.width, CV_8UC1);
  std::ranges::copy(seen.grey, made.data);
  return made;
}

TEST(own_motion, corners_go_where_the_camera_says_within_half_a_pixel) {
  sim::camera::suite_options options;
  options.width = 640;
  options.height = 360;
  const suite_case flight(sim::camera::tuning_seed(3), sim::camera::tier::a, options);
  own_motion motion;
  EXPECT_EQ(motion.step(mat_of(flight.frame(0).seen), std::nullopt).why, unusable::no_homography);
  for (int n = 1; n < 20; ++n) {
    const auto found = motion.step(mat_of(flight.frame(n).seen), std::nullopt);
    ASSERT_EQ(found.why, unusable::none);
    const sim::camera::row_views before(flight.maker().glass(), flight.view_at((n - 1) * suite_case::frame_s));
    const sim::camera::row_views now(flight.maker().glass(), flight.view_at(n * suite_case::frame_s));
    for (const cv::Point2d corner : {cv::Point2d(0, 0), {639, 0}, {0, 359}, {639, 359}}) {
      const auto place = ground_at(flight.maker().world(), before, corner.x, corner.y);
      ASSERT_TRUE(place);
      const auto there = now.project(*place);
      ASSERT_TRUE(there);
      EXPECT_LT(cv::norm(moved(found.before_to_now, corner) - cv::Point2d(there->x, there->y)), 0.5);
    }
  }
}

TEST(own_motion, a_picture_of_another_place_has_no_homography) {
  sim::camera::suite_options options;
  options.width = 640;
  options.height = 360;
  own_motion motion;
  static_cast<void>(motion.step(mat_of(suite_case(0, sim::camera::tier::a, options).frame(0).seen), std::nullopt));
  const auto found = motion.step(mat_of(suite_case(1, sim::camera::tier::a, options).frame(0).seen), std::nullopt);
  EXPECT_NE(found.why, unusable::none);
}

TEST(own_motion, one_spoilt_picture_is_passed_over) {
  sim::camera::suite_options options;
  options.width = 640;
  options.height = 360;
  const suite_case flight(sim::camera::tuning_seed(3), sim::camera::tier::a, options);
  own_motion motion;
  static_cast<void>(motion.step(mat_of(flight.frame(0).seen), std::nullopt));
  const auto other = suite_case(1, sim::camera::tier::a, options).frame(0);
  EXPECT_NE(motion.step(mat_of(other.seen), std::nullopt).why, unusable::none);
  EXPECT_TRUE(motion.is_waiting());
  EXPECT_EQ(motion.step(mat_of(flight.frame(1).seen), std::nullopt).why, unusable::none);
  EXPECT_FALSE(motion.is_waiting());
}

TEST(picture_check, is_reduced_by_whole_numbers_until_it_is_no_wider) {
  EXPECT_EQ(reduction_for(640, 640), 1);
  EXPECT_EQ(reduction_for(641, 640), 2);
  EXPECT_EQ(reduction_for(1280, 640), 2);
  EXPECT_EQ(reduction_for(1920, 640), 3);
}

} // namespace own_motion_test
} // namespace godwit::eyes
