// The core: on an edge, once, latched, only in the air.
#include <gtest/gtest.h>

#include "tests/actors/failsafe/flights.hpp"

namespace core_latch_test {

using namespace godwit::failsafe;
using namespace godwit::tests;

TEST(failsafe_core, on_the_ground_nothing_acts) {
  for (const auto what : {vehicle_class::multirotor, vehicle_class::fixed_wing}) {
    auto world = fenced(what);
    world.landed = landed_state::on_ground;
    world.run_s(3);
    world.east_m = 500;
    world.operator_there = false;
    drain_to(world, 5);
    world.run_s(60);
    EXPECT_TRUE(world.sent.empty());
  }
}

TEST(failsafe_core, disarmed_nothing_acts) {
  auto world = fenced();
  world.armed = false;
  world.run_s(1);
  world.east_m = 500;
  drain_to(world, 5);
  EXPECT_TRUE(world.sent.empty());
}

TEST(failsafe_core, a_rover_that_stands_is_left_alone) {
  auto world = fenced(vehicle_class::rover);
  world.east_mps = 0;
  world.run_s(1);
  world.east_m = 500;
  world.operator_there = false;
  drain_to(world, 5);
  world.run_s(60);
  EXPECT_TRUE(world.sent.empty());
  world.east_mps = 1;
  world.run_s(1);
  EXPECT_EQ(actions_of(world), these{action::hold});
}

TEST(failsafe_core, what_began_on_the_ground_acts_at_take_off) {
  flight_world world;
  world.landed = landed_state::on_ground;
  world.run_s(5);
  drain_to(world, 10);
  EXPECT_TRUE(world.sent.empty());
  world.landed = landed_state::taking_off;
  world.run_s(1);
  EXPECT_EQ(actions_of(world), these{action::land});
}

TEST(failsafe_core, a_cause_that_lasts_acts_once) {
  auto world = fenced();
  world.east_m = 101;
  world.run_s(300);
  EXPECT_EQ(world.sent.size(), 1U);
  EXPECT_EQ(world.acted.size(), 1U);
}

TEST(failsafe_core, a_lower_one_never_cancels_a_higher) {
  auto world = fenced(vehicle_class::rover);
  world.east_m = 101;
  world.run_s(2);
  drain_to(world, 20); // a rover returns for this, and holds for the fence
  world.operator_there = false;
  world.run_s(60);
  EXPECT_EQ(actions_of(world), these{action::hold});
  EXPECT_EQ(world.mode, world.in(mode_kind::hold));
}

TEST(failsafe_core, a_higher_one_cancels_a_lower) {
  flight_world world;
  drain_to(world, 20);
  EXPECT_EQ(actions_of(world), these{action::return_home});
  drain_to(world, 15);
  EXPECT_EQ(actions_of(world), (these{action::return_home, action::land}));
  EXPECT_EQ(world.pilots_seen, 0);
}

TEST(failsafe_core, a_higher_one_that_wants_the_same_sends_nothing_and_takes_the_lower_ones_place) {
  auto world = fenced();
  drain_to(world, 20);
  world.east_m = 101;
  world.run_s(5);
  EXPECT_EQ(actions_of(world), these{action::return_home});
  ASSERT_EQ(world.acted.size(), 2U);
  EXPECT_EQ(world.acted[1].why, rule::fence);
}

TEST(failsafe_core, of_two_in_one_tick_the_higher_acts) {
  auto world = fenced();
  world.landed = landed_state::on_ground;
  world.run_s(3);
  drain_to(world, 10);
  world.east_m = 101;
  world.landed = landed_state::in_air;
  world.run_s(2);
  EXPECT_EQ(actions_of(world), these{action::land});
}

TEST(failsafe_core, an_override_that_lifts_a_return_gives_what_was_covered_its_say) {
  auto world = fenced(vehicle_class::rover);
  world.east_m = 101;
  world.run_s(2);
  drain_to(world, 20);
  EXPECT_EQ(actions_of(world), these{action::hold});
  world.override_for_s(rule::fence, 600);
  world.run_s(1);
  EXPECT_EQ(world.lifted.size(), 1U);
  EXPECT_EQ(actions_of(world), (these{action::hold, action::return_home}));
}

TEST(failsafe_core, an_override_of_what_something_worse_has_covered_takes_that_latch_alone) {
  auto world = fenced();
  world.operator_there = false;
  world.run_s(31);
  drain_to(world, 5);
  ASSERT_EQ(actions_of(world).back(), action::land);
  const auto is_latched = [&](rule which) {
    return std::ranges::find(world.told().latched, which) != world.told().latched.end();
  };
  ASSERT_TRUE(is_latched(rule::operator_link) && is_latched(rule::battery_critical));
  world.override_for_s(rule::operator_link, 600);
  world.run_s(1);
  EXPECT_FALSE(is_latched(rule::operator_link));
  EXPECT_TRUE(is_latched(rule::battery_critical));
}

TEST(failsafe_core, who_returns_or_lands_already_is_not_told_to_return) {
  for (const auto& mode : {in_return, in_landing}) {
    flight_world world;
    world.tell(expect_mode{{mode.custom_mode}, 5'000});
    world.run_s(1);
    world.mode = mode;
    world.run_s(1);
    drain_to(world, 20);
    EXPECT_TRUE(world.sent.empty());
    EXPECT_EQ(world.acted.size(), 1U) << "it is latched all the same";
  }
}

TEST(failsafe_core, the_next_flight_begins_with_no_latch) {
  auto world = fenced();
  world.east_m = 101;
  world.run_s(2);
  world.landed = landed_state::on_ground;
  world.run_s(3);
  world.armed = false;
  world.east_m = 0;
  world.mode = in_mission;
  world.run_s(3);
  world.armed = true;
  world.landed = landed_state::in_air;
  world.run_s(3);
  EXPECT_EQ(world.sent.size(), 1U);
  world.east_m = 101;
  world.run_s(2);
  EXPECT_EQ(world.sent.size(), 2U);
}

TEST(failsafe_core, a_vehicle_of_unknown_kind_is_not_commanded_and_health_is_red) {
  flight_world world(vehicle_class::unknown);
  drain_to(world, 10);
  EXPECT_TRUE(world.sent.empty());
  EXPECT_EQ(world.health().how, godwit::runtime::health_colour::red);
}

} // namespace core_latch_test
