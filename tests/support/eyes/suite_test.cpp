#include "tests/support/eyes/suite.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace godwit::sim::camera {
namespace suite_test {

suite_options of_size(int width, int height) {
  suite_options options;
  options.width = width;
  options.height = height;
  return options;
}

TEST(camera_suite, a_third_of_the_seeds_is_held_back_and_the_two_lists_share_none) {
  for (std::uint64_t n = 0; n < 300; ++n) {
    EXPECT_FALSE(is_held_back(tuning_seed(n)));
    EXPECT_TRUE(is_held_back(held_back_seed(n)));
  }
  EXPECT_EQ(tuning_seed(0), 0U);
  EXPECT_EQ(tuning_seed(1), 1U);
  EXPECT_EQ(tuning_seed(2), 3U);
}

TEST(camera_suite, the_ends_of_the_ranges_are_seen_by_held_back_seeds_only) {
  const suite_ranges ranges;
  const double sixth = (ranges.height_m.most - ranges.height_m.least) / 6;
  suite_options options = of_size(64, 48);
  options.has_movers = false;
  int at_the_ends = 0;
  for (std::uint64_t n = 0; n < 12; ++n) {
    const double tuned = -suite_case(tuning_seed(n), tier::a, options).view_at(0).position.z;
    EXPECT_GE(tuned, ranges.height_m.least + sixth);
    EXPECT_LE(tuned, ranges.height_m.most - sixth);
    const double held = -suite_case(held_back_seed(n), tier::a, options).view_at(0).position.z;
    EXPECT_GE(held, ranges.height_m.least);
    EXPECT_LE(held, ranges.height_m.most);
    at_the_ends += held < ranges.height_m.least + sixth || held > ranges.height_m.most - sixth ? 1 : 0;
  }
  EXPECT_GT(at_the_ends, 0);
}

TEST(camera_suite, velocity_and_rate_are_those_of_the_flight) {
  const suite_case flight(3, tier::a, of_size(64, 48));
  const auto before = flight.view_at(1.0);
  const auto after = flight.view_at(1.01);
  EXPECT_NEAR((after.position.x - before.position.x) / 0.01, before.velocity.x, 0.05);
  const auto turn = turn_between(before.attitude, after.attitude);
  EXPECT_NEAR(turn.z / 0.01, before.rate.z, 0.02);
}

TEST(camera_suite, movers_have_the_size_of_the_range_in_the_picture) {
  int seen = 0;
  for (const std::uint64_t seed : {0U, 1U, 3U, 4U}) {
    const suite_case flight(seed, tier::a, of_size(320, 180));
    for (int frame = 0; frame < 100; frame += 20)
      for (const auto& each : flight.frame(frame).real.movers) {
        if (each.is_cut)
          continue;
        ++seen;
        // 10 to 40 pixels of a picture four times as wide; the height above the ground and the oblique view add to it.
        EXPECT_LT(std::max(each.width_px, each.height_px), 60 / 4.0);
        EXPECT_GT(std::max(each.width_px, each.height_px), 6 / 4.0);
      }
  }
  EXPECT_GT(seen, 20);
}

} // namespace suite_test
} // namespace godwit::sim::camera
