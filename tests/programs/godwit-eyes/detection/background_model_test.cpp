#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "programs/godwit-eyes/detection/background_model.hpp"
#include "programs/godwit-eyes/detection/blobs.hpp"
#include "programs/godwit-sim/camera/random.hpp"

namespace godwit::eyes {

namespace background_model_test {

const cv::Size picture(320, 180);

cv::Mat wide_ground() {
  sim::camera::random_source random(4);
  cv::Mat made(400, 1400, CV_8UC1);
  for (int y = 0; y < made.rows; ++y)
    for (int x = 0; x < made.cols; ++x)
      made.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(random.between(70, 160));
  cv::GaussianBlur(made, made, cv::Size(3, 3), 0.8);
  return made;
}

// The camera goes to the right over the ground, by whole pixels.
struct over_ground {
  cv::Mat next(int right_px) {
    left += right_px;
    return ground(cv::Rect(cv::Point(left, 100), picture)).clone();
  }
  [[nodiscard]] static cv::Matx33d moved_by(int right_px) { return {1, 0, -double(right_px), 0, 1, 0, 0, 0, 1}; }
  cv::Mat ground = wide_ground();
  int left = 0;
};

TEST(background_model, a_long_way_over_still_ground_finds_nothing_and_a_thing_as_a_whole) {
  over_ground flight;
  background_model of;
  for (int n = 0; n < 200; ++n) {
    const cv::Mat& mask = of.look(flight.next(5), over_ground::moved_by(5));
    EXPECT_EQ(cv::countNonZero(mask), 0) << n;
  }
  cv::Mat now = flight.next(5);
  now(cv::Rect(100, 60, 12, 8)) = 250;
  const auto found = find_blobs(of.look(now, over_ground::moved_by(5)));
  ASSERT_EQ(found.blobs.size(), 1U);
  EXPECT_EQ(found.blobs[0].box, cv::Rect2d(100, 60, 12, 8));
}

TEST(background_model, a_way_in_any_direction_over_still_ground_finds_nothing) {
  const cv::Mat ground = wide_ground();
  for (const auto& by : {cv::Point(4, 1), cv::Point(-4, -1), cv::Point(3, -2), cv::Point(-3, 2)}) {
    cv::Point at(by.x > 0 ? 20 : 1060, by.y > 0 ? 4 : 216);
    background_model of;
    for (int n = 0; n < 90; ++n) {
      const cv::Matx33d moved(1, 0, n == 0 ? 0 : -by.x, 0, 1, n == 0 ? 0 : -by.y, 0, 0, 1);
      EXPECT_EQ(cv::countNonZero(of.look(ground(cv::Rect(at, picture)).clone(), moved)), 0) << by << n;
      at += by;
    }
    cv::Mat now = ground(cv::Rect(at, picture)).clone();
    now(cv::Rect(100, 60, 12, 8)) = 250;
    const auto found = find_blobs(of.look(now, {1, 0, -double(by.x), 0, 1, -double(by.y), 0, 0, 1}));
    ASSERT_EQ(found.blobs.size(), 1U) << by << "the ground is still known";
    EXPECT_EQ(found.blobs[0].box, cv::Rect2d(100, 60, 12, 8));
  }
}

TEST(background_model, what_was_seen_before_a_turn_that_needs_a_new_canvas_is_still_known) {
  over_ground flight;
  background_model of;
  const cv::Mat still = flight.next(0);
  for (int n = 0; n < 10; ++n)
    (void)of.look(still, cv::Matx33d::eye());
  const cv::Matx33d turn = [] {
    const cv::Mat about = cv::getRotationMatrix2D({160, 90}, 60, 1);
    return cv::Matx33d(about.at<double>(0, 0), about.at<double>(0, 1), about.at<double>(0, 2), about.at<double>(1, 0),
                       about.at<double>(1, 1), about.at<double>(1, 2), 0, 0, 1);
  }();
  cv::Mat turned;
  cv::warpPerspective(still, turned, turn, picture, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  cv::circle(turned, {160, 90}, 6, cv::Scalar(250), cv::FILLED);
  const auto found = find_blobs(of.look(turned, turn));
  ASSERT_EQ(found.blobs.size(), 1U) << "around the middle the ground is known";
  EXPECT_NEAR(found.blobs[0].box.width, 13, 2);
}

TEST(blobs, a_shadow_is_left_out_of_the_box_of_what_throws_it) {
  cv::Mat mask = cv::Mat::zeros(picture, CV_8UC1);
  mask(cv::Rect(100, 60, 10, 10)) = mask_value::sure;
  mask(cv::Rect(110, 60, 10, 10)) = mask_value::shadow_sure;
  const auto found = find_blobs(mask);
  ASSERT_EQ(found.blobs.size(), 1U);
  EXPECT_EQ(found.blobs[0].box, cv::Rect2d(100, 60, 9, 10)) << "the column that touches it is taken for its edge";
}

TEST(blobs, the_half_lit_edge_of_a_shadow_is_left_out_of_the_box_too) {
  cv::Mat mask = cv::Mat::zeros(picture, CV_8UC1);
  mask(cv::Rect(100, 60, 10, 10)) = mask_value::sure;
  mask(cv::Rect(110, 60, 11, 10)) = mask_value::may_be;
  mask(cv::Rect(110, 60, 10, 10)) = mask_value::shadow_sure;
  const auto found = find_blobs(mask);
  ASSERT_EQ(found.blobs.size(), 1U);
  EXPECT_EQ(found.blobs[0].box, cv::Rect2d(100, 60, 9, 10));
}

TEST(blobs, what_is_as_dark_as_a_shadow_all_over_keeps_its_box) {
  cv::Mat mask = cv::Mat::zeros(picture, CV_8UC1);
  mask(cv::Rect(100, 60, 20, 10)) = mask_value::shadow_sure;
  mask(cv::Rect(100, 60, 2, 2)) = mask_value::sure;
  const auto found = find_blobs(mask);
  ASSERT_EQ(found.blobs.size(), 1U);
  EXPECT_EQ(found.blobs[0].box, cv::Rect2d(100, 60, 20, 10));
}

} // namespace background_model_test

namespace shadow_ratio_test {

// Pictures with dark things of any brightness, and a part of them in shadows of this ratio.
shadow_ratio seen(double shadows, float ratio, int pictures = 20) {
  sim::camera::random_source random(3);
  shadow_ratio of;
  for (int n = 0; n < pictures; ++n) {
    for (int pixel = 0; pixel < 500; ++pixel) {
      const bool is_shadow = random.uniform() < shadows;
      of.add(static_cast<float>(is_shadow ? ratio + 0.01 * random.gaussian() : random.between(0.2, 1.0)));
    }
    of.end_picture();
  }
  return of;
}

TEST(shadow_ratio, what_many_dark_pixels_have_in_common_is_the_shadow) {
  for (const float ratio : {0.45F, 0.6F, 0.75F}) {
    const auto found = seen(0.5, ratio).get();
    ASSERT_TRUE(found);
    EXPECT_NEAR(*found, ratio, 0.02);
  }
}

TEST(shadow_ratio, where_dark_things_are_of_any_brightness_there_is_none) { EXPECT_FALSE(seen(0, 0.6F).get()); }

TEST(shadow_ratio, a_few_pixels_are_not_enough) {
  shadow_ratio of;
  for (int n = 0; n < 50; ++n)
    of.add(0.6F);
  of.end_picture();
  EXPECT_FALSE(of.get());
}

TEST(shadow_ratio, when_the_shadows_are_gone_it_is_forgotten) {
  auto of = seen(0.5, 0.6F);
  for (int n = 0; n < 300; ++n)
    of.end_picture();
  EXPECT_FALSE(of.get());
}

} // namespace shadow_ratio_test

} // namespace godwit::eyes
