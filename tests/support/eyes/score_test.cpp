#include "tests/support/eyes/score.hpp"

#include <gtest/gtest.h>

namespace godwit::eyes::test {
namespace score_test {

sim::camera::true_mover mover_at(double x, double y, double size) {
  sim::camera::true_mover made;
  made.x_px = x;
  made.y_px = y;
  made.width_px = size;
  made.height_px = size;
  made.visible_share = 1;
  made.speed_px_s = 90;
  return made;
}

TEST(eyes_score, overlap_is_intersection_by_union) {
  EXPECT_DOUBLE_EQ(overlap_of({0, 0, 10, 10}, {0, 0, 10, 10}), 1);
  EXPECT_DOUBLE_EQ(overlap_of({0, 0, 10, 10}, {5, 0, 10, 10}), 50.0 / 150);
  EXPECT_DOUBLE_EQ(overlap_of({0, 0, 10, 10}, {10, 0, 10, 10}), 0);
}

TEST(eyes_score, each_mover_is_found_once_and_by_the_box_that_fits_best) {
  sim::camera::truth real;
  real.movers = {mover_at(100, 100, 20)};
  const std::vector<pixel_box> seen{{104, 100, 20, 20}, {100, 100, 20, 20}};
  const score result = score_of(real, seen, {});
  EXPECT_EQ(result.found, 1);
  EXPECT_EQ(result.wrong, 1);
  EXPECT_EQ(result.missed, 0);
}

TEST(eyes_score, what_is_hidden_small_slow_or_cut_counts_for_nothing_and_neither_does_a_box_on_it) {
  sim::camera::truth real;
  real.movers.assign(4, mover_at(0, 300, 20));
  for (std::size_t n = 0; n < 4; ++n)
    real.movers[n].x_px = 100 + 100.0 * static_cast<double>(n);
  real.movers[0].visible_share = 0.4;
  real.movers[1].width_px = real.movers[1].height_px = 6;
  real.movers[2].speed_px_s = 3;
  real.movers[3].is_cut = true;
  std::vector<pixel_box> seen;
  for (const auto& each : real.movers)
    seen.push_back({each.x_px, each.y_px, each.width_px, each.height_px});
  const score result = score_of(real, seen, {});
  EXPECT_EQ(result.found + result.missed + result.wrong, 0);
}

TEST(eyes_score, a_box_on_nothing_is_wrong_but_not_at_the_border) {
  const std::vector<pixel_box> seen{{500, 300, 20, 20}, {0, 300, 20, 20}};
  EXPECT_EQ(score_of({}, seen, {}).wrong, 1);
}

TEST(eyes_score, f1_is_that_of_the_sums) {
  score sum{3, 1, 0};
  sum += score{1, 1, 2};
  EXPECT_DOUBLE_EQ(sum.f1(), 8.0 / 12);
  EXPECT_DOUBLE_EQ(sum.precision(), 4.0 / 6);
  EXPECT_DOUBLE_EQ(sum.recall(), 4.0 / 6);
}

} // namespace score_test
} // namespace godwit::eyes::test
