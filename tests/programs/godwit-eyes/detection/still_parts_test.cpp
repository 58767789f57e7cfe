#include "programs/godwit-eyes/detection/still_parts.hpp"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace godwit::eyes {
namespace still_parts_test {

constexpr double picture_s = 0.1;
constexpr int way_px = 6; // of the ground, from picture to picture
const cv::Size size(320, 240);
const cv::Rect text(20, 20, 60, 12);
const cv::Rect follower(150, 100, 20, 30); // a mover that the camera keeps in its middle

cv::Mat ground() {
  cv::RNG random(7);
  cv::Mat made(300, 900, CV_8UC1);
  random.fill(made, cv::RNG::UNIFORM, 40, 200);
  cv::GaussianBlur(made, made, cv::Size(5, 5), 1.5);
  return made;
}

// What is left of a mask that is full, after so many pictures over ground that goes to the left.
cv::Mat left_after(int pictures, int way) {
  const cv::Mat all = ground();
  cv::RNG random(3);
  still_parts of;
  for (int n = 0; n < pictures; ++n) {
    cv::Mat now = all(cv::Rect(cv::Point(way * n, 0), size)).clone();
    for (int x = text.x; x < text.br().x; x += 10)
      cv::rectangle(now, cv::Rect(x, text.y, 3, text.height), cv::Scalar(255), cv::FILLED);
    cv::Mat walks(follower.size(), CV_8UC1);
    random.fill(walks, cv::RNG::UNIFORM, 0, 120);
    walks.copyTo(now(follower));
    of.step(now, picture_s, cv::Matx33d(1, 0, -way, 0, 1, 0, 0, 0, 1));
  }
  cv::Mat mask(size, CV_8UC1, cv::Scalar(255));
  of.clear(mask);
  return mask;
}

TEST(still_parts, text_that_stands_while_the_ground_goes_by_is_cleared_and_nothing_else_is) {
  const cv::Mat left = left_after(60, way_px);
  EXPECT_LT(cv::countNonZero(left(text)), 0.05 * text.area());
  EXPECT_EQ(cv::countNonZero(left(follower)), follower.area());
  EXPECT_GT(cv::countNonZero(left), 0.9 * size.area());
}

TEST(still_parts, nothing_is_cleared_before_it_stood_for_two_seconds) {
  EXPECT_EQ(cv::countNonZero(left_after(18, way_px)), size.area());
}

TEST(still_parts, where_the_ground_stands_too_nothing_can_be_known_to) {
  EXPECT_EQ(cv::countNonZero(left_after(60, 0)), size.area());
}

} // namespace still_parts_test
} // namespace godwit::eyes
