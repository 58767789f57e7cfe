#include "programs/godwit-eyes/detection/places.hpp"

#include <gtest/gtest.h>

namespace godwit::eyes {
namespace {

constexpr double one = 1 << place_bits;
const cv::Size picture(640, 360);
// Turned, half as large again at the right, and shifted.
const cv::Matx33d tilted(0.98, -0.1, 12, 0.09, 1.01, -7, 2e-4, -1e-4, 1);

TEST(places, each_pixel_lies_where_the_homography_has_it_to_a_twentieth_of_a_pixel) {
  int pixels = 0;
  double farthest = 0;
  for_each_run(picture, tilted, [&](const placed_run& run) {
    for (int x = run.begin; x < run.end; ++x, ++pixels) {
      const cv::Point at = run.place + (x - run.begin) * run.step;
      farthest = std::max(farthest, cv::norm(cv::Point2d(at) / one - moved(tilted, cv::Point2d(x, run.y))));
    }
  });
  EXPECT_EQ(pixels, picture.area());
  EXPECT_LT(farthest, 0.05);
}

TEST(places, what_lies_outside_of_the_other_picture_is_left_out) {
  const cv::Matx33d right(1, 0, 100.4, 0, 1, 0, 0, 0, 1);
  int pixels = 0;
  for_each_run(picture, right, [&](const placed_run& run) {
    for_each_nearest(run, picture, [&](int x, int column, int row) {
      EXPECT_EQ(column, x + 100);
      EXPECT_EQ(row, run.y);
      ++pixels;
    });
  });
  EXPECT_EQ(pixels, (picture.width - 100) * picture.height);
}

} // namespace
} // namespace godwit::eyes
