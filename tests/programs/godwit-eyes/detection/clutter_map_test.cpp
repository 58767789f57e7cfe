#include "programs/godwit-eyes/detection/clutter_map.hpp"

#include <gtest/gtest.h>

#include "programs/godwit-sim/camera/random.hpp"

namespace godwit::eyes {
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
