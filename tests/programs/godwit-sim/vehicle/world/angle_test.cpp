#include "programs/godwit-sim/vehicle/world/angle.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace godwit::sim::test {
namespace angle_test {

TEST(sim_angle, headings_are_0_to_360_without_360) {
  EXPECT_EQ(heading_of(0), 0);
  EXPECT_EQ(heading_of(360), 0);
  EXPECT_EQ(heading_of(-90), 270);
  EXPECT_EQ(heading_of(725), 5);
  EXPECT_LT(heading_of(-1e-300), 360);
}

TEST(sim_angle, a_turn_takes_the_short_way) {
  EXPECT_EQ(turn_of(350), -10);
  EXPECT_EQ(turn_of(-350), 10);
  EXPECT_EQ(turn_of(90), 90);
}

RC_GTEST_PROP(sim_angle, turning_by_the_difference_of_two_headings_leads_from_one_to_the_other, ()) {
  const double from_deg = heading_of(*rc::gen::inRange(-1'000'000, 1'000'000) / 1e3);
  const double to_deg = heading_of(*rc::gen::inRange(-1'000'000, 1'000'000) / 1e3);
  RC_ASSERT(from_deg >= 0 && from_deg < 360);
  const double turn_deg = turn_of(to_deg - from_deg);
  RC_ASSERT(turn_deg >= -180 && turn_deg <= 180);
  RC_ASSERT(std::abs(turn_of(from_deg + turn_deg - to_deg)) < 1e-9);
}

} // namespace angle_test
} // namespace godwit::sim::test
