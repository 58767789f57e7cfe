// The core: the battery.
#include <iterator>

#include <gtest/gtest.h>

#include "tests/actors/failsafe/flights.hpp"

namespace core_battery_test {

using namespace godwit::failsafe;
using namespace godwit::tests;

TEST(failsafe_core, at_15_percent_a_multirotor_lands_an_aeroplane_returns_and_a_rover_holds) {
  const these wanted[] = {{action::land}, {action::return_home}, {action::hold}};
  for (std::size_t i = 0; i < std::size(classes); ++i) {
    flight_world world(classes[i]);
    world.override_for_s(rule::battery_low, 3'000);
    world.run_s(1);
    drain_to(world, 15);
    EXPECT_EQ(actions_of(world), wanted[i]);
  }
}

TEST(failsafe_core, at_15_percent_an_aeroplane_takes_the_landing_of_its_mission) {
  flight_world world(vehicle_class::fixed_wing);
  world.set_fences({}, landing_sequence);
  world.override_for_s(rule::battery_low, 3'000);
  drain_to(world, 14);
  EXPECT_EQ(actions_of(world), these{action::do_land_start});
  world.run_s(30);
  EXPECT_EQ(world.sent.size(), 1U);
  EXPECT_EQ(world.pilots_seen, 0);
}

TEST(failsafe_core, an_aeroplane_that_is_at_its_landing_already_is_not_told_to_begin_it_again) {
  flight_world world(vehicle_class::fixed_wing);
  world.set_fences({}, landing_sequence);
  world.override_for_s(rule::battery_low, 3'000);
  world.run_s(1);
  world.sequence = landing_sequence + 2;
  drain_to(world, 14);
  EXPECT_TRUE(world.sent.empty());
  EXPECT_EQ(world.acted.size(), 1U);
}

TEST(failsafe_core, a_sequence_of_the_plan_before_or_of_no_plan_is_no_landing) {
  for (const std::uint16_t sequence : {std::uint16_t{landing_sequence}, std::uint16_t{65535}}) {
    flight_world world(vehicle_class::fixed_wing);
    world.override_for_s(rule::battery_low, 3'000);
    world.sequence = sequence;
    world.run_s(1);
    world.sends_sequence = sequence == 65535;
    world.set_fences({}, landing_sequence);
    drain_to(world, 14);
    EXPECT_EQ(actions_of(world).at(0), action::do_land_start);
  }
}

TEST(failsafe_core, at_25_percent_every_vehicle_returns) {
  for (const auto what : classes) {
    flight_world world(what);
    drain_to(world, 25);
    EXPECT_EQ(actions_of(world), these{action::return_home});
  }
}

TEST(failsafe_core, a_low_battery_can_be_overridden_until_a_deadline_and_a_critical_one_never) {
  flight_world world;
  world.override_for_s(rule::battery_low, 600);
  world.override_for_s(rule::battery_critical, 600);
  world.run_s(1);
  ASSERT_EQ(world.answered.size(), 2U);
  EXPECT_NE(world.answered[0].taken, world.answered[1].taken);
  drain_to(world, 20);
  EXPECT_TRUE(world.sent.empty());
  drain_to(world, 15);
  EXPECT_EQ(actions_of(world), these{action::land});
}

TEST(failsafe_core, a_battery_that_jumps_by_more_than_20_points_is_unknown_and_yellow_and_nothing_is_done) {
  flight_world world;
  world.run_s(10);
  for (int i = 0; i < 30; ++i) {
    world.battery_percent = i % 2 == 0 ? 10 : 60;
    world.run_s(1);
    EXPECT_EQ(world.health().how, godwit::runtime::health_colour::yellow);
  }
  EXPECT_TRUE(world.sent.empty());
}

TEST(failsafe_core, a_battery_of_which_the_autopilot_knows_nothing_is_yellow_and_nothing_is_done) {
  flight_world world;
  world.battery_percent = -1;
  world.run_s(60);
  EXPECT_TRUE(world.sent.empty());
  EXPECT_EQ(world.health().how, godwit::runtime::health_colour::yellow);
}

} // namespace core_battery_test
