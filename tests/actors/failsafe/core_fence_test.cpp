// The core: the fences.
#include <algorithm>
#include <iterator>

#include <gtest/gtest.h>

#include "tests/actors/failsafe/flights.hpp"

namespace core_fence_test {

using namespace godwit::failsafe;
using namespace godwit::tests;
using godwit::mission::fence_kind;

TEST(failsafe_core, a_breach_returns_what_flies_and_stops_a_rover_within_a_tick_of_the_second_position) {
  const these wanted[] = {{action::return_home}, {action::return_home}, {action::hold}};
  for (std::size_t i = 0; i < std::size(classes); ++i) {
    auto world = fenced(classes[i]);
    EXPECT_TRUE(world.sent.empty());
    world.east_m = 101; // with the position that goes out now
    const auto breached_ms = world.now_ms();
    world.run_s(10);
    EXPECT_EQ(actions_of(world), wanted[i]);
    EXPECT_LE(*world.first_sent_ms - breached_ms, 200 + 250);
  }
}

TEST(failsafe_core, above_the_ceiling_is_a_breach) {
  auto world = fenced();
  world.altitude_m = 121;
  world.run_s(1);
  EXPECT_EQ(actions_of(world), these{action::return_home});
}

TEST(failsafe_core, below_the_floor_is_a_breach_after_it_was_above) {
  flight_world world;
  world.set_fences({fence_of(fence_kind::inclusion, square(100), 30)});
  world.landed = landed_state::taking_off;
  world.altitude_m = 10;
  world.run_s(3);
  world.landed = landed_state::in_air;
  world.run_s(3);
  EXPECT_TRUE(world.sent.empty()) << "it climbs";
  world.altitude_m = 40;
  world.run_s(3);
  world.altitude_m = 29;
  world.run_s(1);
  EXPECT_EQ(actions_of(world), these{action::return_home});
}

TEST(failsafe_core, inside_of_an_exclusion_fence_is_a_breach) {
  flight_world world;
  world.set_fences({fence_of(fence_kind::exclusion, square(20, 100, 0))});
  world.run_s(3);
  EXPECT_TRUE(world.sent.empty());
  world.east_m = 81;
  world.run_s(1);
  EXPECT_EQ(actions_of(world), these{action::return_home});
}

TEST(failsafe_core, a_corner_that_was_cut_between_two_positions_is_a_breach) {
  flight_world world;
  world.set_fences({fence_of(fence_kind::exclusion, square(2, 20, 0))});
  world.run_s(1);
  world.east_m = 40;
  world.run_s(1);
  EXPECT_EQ(actions_of(world), these{action::return_home});
}

TEST(failsafe_core, where_it_will_be_in_2_s_is_a_warning_and_no_breach) {
  auto world = fenced();
  ASSERT_TRUE(world.warnings.empty());
  world.east_m = 97;
  world.run_s(10);
  EXPECT_TRUE(world.sent.empty());
  EXPECT_TRUE(world.has_warned_of("a fence is near"));
  EXPECT_EQ(std::count_if(world.warnings.begin(), world.warnings.end(),
                          [](const std::string& each) { return each.find("near") != std::string::npos; }),
            1);
}

TEST(failsafe_core, a_position_older_than_1_s_gives_no_verdict_and_is_yellow) {
  auto world = fenced();
  world.sends_positions = false;
  world.east_m = 500;
  world.run_s(5);
  EXPECT_EQ(world.health().how, godwit::runtime::health_colour::yellow);
  EXPECT_NE(world.health().reason.find("position"), std::string::npos);
  EXPECT_TRUE(world.sent.empty());
}

TEST(failsafe_core, each_change_of_its_health_is_told_once) {
  auto world = fenced();
  world.told_health.clear();
  world.sends_positions = false;
  world.run_s(3);
  ASSERT_EQ(world.told_health.size(), 1U);
  EXPECT_EQ(world.told_health.back(), world.health());
  world.sends_positions = true;
  world.run_s(3);
  ASSERT_EQ(world.told_health.size(), 2U);
  EXPECT_EQ(world.told_health.back(), world.health());
}

TEST(failsafe_core, coming_back_over_the_fence_does_not_cancel_the_return) {
  auto world = fenced();
  world.east_m = 101;
  world.run_s(2);
  world.east_m = 50;
  world.run_s(20);
  world.east_m = 101;
  world.run_s(20);
  EXPECT_EQ(world.sent.size(), 1U);
  EXPECT_EQ(world.mode, in_return);
}

TEST(failsafe_core, fences_that_are_refused_leave_the_ones_from_before) {
  auto world = fenced();
  world.set_fences({fence_of(fence_kind::inclusion, {{0, 0}, {1, 1}})});
  world.run_s(1);
  ASSERT_EQ(world.limits_answered.size(), 2U);
  EXPECT_FALSE(world.limits_answered[1].taken);
  EXPECT_FALSE(world.limits_answered[1].reason.empty());
  EXPECT_EQ(world.health().how, godwit::runtime::health_colour::red);
  world.east_m = 101;
  world.run_s(1);
  EXPECT_EQ(actions_of(world), these{action::return_home});
}

} // namespace core_fence_test
