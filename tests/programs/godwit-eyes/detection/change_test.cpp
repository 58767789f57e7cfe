#include "programs/godwit-eyes/detection/change.hpp"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "programs/godwit-eyes/detection/blobs.hpp"
#include "programs/godwit-sim/camera/random.hpp"

namespace godwit::eyes {
namespace change_test {

constexpr double picture_s = 0.1;
constexpr int least = 8;

cv::Mat ground() {
  sim::camera::random_source random(4);
  cv::Mat made(180, 320, CV_8UC1);
  for (int y = 0; y < made.rows; ++y)
    for (int x = 0; x < made.cols; ++x)
      made.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(random.between(90, 130));
  cv::GaussianBlur(made, made, cv::Size(5, 5), 1.2);
  return made;
}

cv::Mat with_thing_at(int x, std::uint8_t brightness = 250) {
  cv::Mat made = ground();
  made(cv::Rect(x, 80, 12, 8)) = brightness;
  return made;
}

TEST(recent_change, what_moves_is_found_where_it_is_and_not_where_it_was) {
  recent_change of;
  for (int n = 0; n < 5; ++n)
    of.add(with_thing_at(100 + 15 * n), picture_s, cv::Matx33d::eye());
  const auto found = find_blobs(of.find(recent_change::quick_s, least));
  ASSERT_EQ(found.blobs.size(), 1U);
  EXPECT_GT((found.blobs[0].box & cv::Rect2d(160, 80, 12, 8)).area(), 0.6 * 12 * 8);
  EXPECT_EQ((found.blobs[0].box & cv::Rect2d(100, 0, 57, 180)).area(), 0);
}

TEST(recent_change, what_stands_is_not_found_nor_ground_that_is_laid_a_pixel_off) {
  recent_change of;
  for (int n = 0; n < 5; ++n)
    of.add(with_thing_at(100), picture_s, cv::Matx33d(1, 0, n % 2 == 0 ? 0.7 : -0.7, 0, 1, 0, 0, 0, 1));
  EXPECT_TRUE(find_blobs(of.find(recent_change::quick_s, least)).blobs.empty());
}

TEST(recent_change, it_is_ready_when_two_earlier_pictures_are_old_enough) {
  recent_change of;
  for (int n = 0; n < 3; ++n) {
    EXPECT_FALSE(of.is_ready()) << n;
    of.add(ground(), picture_s, cv::Matx33d::eye());
  }
  EXPECT_TRUE(of.is_ready());
  of.forget();
  EXPECT_FALSE(of.is_ready());
}

TEST(recent_change, what_goes_slowly_is_found_over_a_longer_time) {
  recent_change of;
  for (int n = 0; n < 8; ++n)
    of.add(with_thing_at(100 + 5 * n), picture_s, cv::Matx33d::eye());
  const cv::Rect thing(135, 80, 12, 8);
  const auto share = [&](double gap_s) {
    return cv::countNonZero(of.find(gap_s, least)(thing)) / double(thing.area());
  };
  EXPECT_LT(share(recent_change::quick_s), 0.5);
  EXPECT_GT(share(recent_change::slow_s), 0.7);
}

} // namespace change_test
} // namespace godwit::eyes
