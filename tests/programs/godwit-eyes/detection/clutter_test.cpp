#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "programs/godwit-eyes/detection/clutter.hpp"
#include "programs/godwit-sim/camera/random.hpp"

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

// After so many pictures over ground that goes to the left.
still_parts parts_after(int pictures, int way) {
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
  return of;
}

// What is left of a mask that is full.
cv::Mat left_after(int pictures, int way) {
  cv::Mat mask(size, CV_8UC1, cv::Scalar(255));
  parts_after(pictures, way).clear(mask);
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

TEST(still_parts, text_is_doubted_after_half_a_second_and_a_mover_that_is_followed_and_the_ground_are_not) {
  const still_parts of = parts_after(6, way_px);
  EXPECT_TRUE(of.may_stand(text));
  EXPECT_FALSE(of.may_stand(follower));
  EXPECT_FALSE(of.may_stand(cv::Rect(200, 180, 60, 12)));
}

TEST(still_parts, where_the_ground_stands_too_nothing_can_be_known_to) {
  EXPECT_EQ(cv::countNonZero(left_after(60, 0)), size.area());
}

} // namespace still_parts_test

namespace clutter_map_test {

constexpr double picture_s = 1.0 / 30;
const cv::Size picture(640, 360);
const cv::Matx33d still = cv::Matx33d::eye();

blob blob_at(double x, double y, double size = 10) {
  return {cv::Rect2d(x - size / 2, y - size / 2, size, size), static_cast<int>(size * size), 50};
}

TEST(clutter_map, what_comes_and_goes_makes_its_own_place_cluttered_and_no_other) {
  sim::camera::random_source random(3);
  clutter_map of;
  for (int n = 0; n < 150; ++n) {
    std::vector<blob> blobs;
    for (int k = 0; k < 12; ++k)
      blobs.push_back(blob_at(random.between(400, 600), random.between(50, 300), 4));
    of.step(blobs, picture_s, still, picture);
  }
  EXPECT_FALSE(of.is_calm());
  EXPECT_FALSE(of.is_calm_at({500, 180}));
  EXPECT_TRUE(of.is_calm_at({100, 180}));
}

TEST(clutter_map, many_that_move_and_stay_together_are_no_clutter) {
  clutter_map of;
  for (int n = 0; n < 150; ++n) {
    std::vector<blob> blobs;
    for (int k = 0; k < 12; ++k)
      blobs.push_back(blob_at(20 + 50.0 * k + 0.5 * n, 100));
    of.step(blobs, picture_s, still, picture);
  }
  EXPECT_FALSE(of.is_calm());
  EXPECT_TRUE(of.is_calm_at({320, 100}));
}

TEST(clutter_map, a_few_that_come_and_go_make_the_picture_cluttered_and_a_few_that_stay_do_not) {
  for (const bool they_stay : {true, false}) {
    sim::camera::random_source random(3);
    clutter_map of;
    for (int n = 0; n < 60; ++n) {
      std::vector<blob> blobs;
      for (int k = 0; k < 5; ++k)
        blobs.push_back(they_stay ? blob_at(20 + 100.0 * k, 100)
                                  : blob_at(random.between(20, 620), random.between(20, 340), 4));
      of.step(blobs, picture_s, still, picture);
    }
    EXPECT_EQ(of.is_calm(), they_stay);
  }
}

TEST(clutter_map, it_goes_along_with_the_ground) {
  sim::camera::random_source random(3);
  const cv::Matx33d ground(1, 0, 4, 0, 1, 0, 0, 0, 1);
  clutter_map of;
  for (int n = 0; n < 60; ++n) {
    std::vector<blob> blobs;
    for (int k = 0; k < 12; ++k)
      blobs.push_back(blob_at(random.between(0, 100) + 4 * n, random.between(50, 300), 4));
    of.step(blobs, picture_s, ground, picture);
  }
  EXPECT_GT(of.births_around({290, 180}), 2 * of.births_around({50, 180}));
}

TEST(clutter_map, what_was_not_seen_yet_is_not_trusted_and_a_few_blobs_are) {
  clutter_map of;
  of.step({}, picture_s, still, picture);
  EXPECT_FALSE(of.is_calm());
  for (int n = 0; n < 60; ++n)
    of.step(std::vector{blob_at(100, 100)}, picture_s, still, picture);
  EXPECT_TRUE(of.is_calm());
  EXPECT_EQ(of.births_around({100, 100}), 0);
}

} // namespace clutter_map_test

} // namespace godwit::eyes
