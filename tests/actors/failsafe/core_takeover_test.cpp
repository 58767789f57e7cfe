// The core: who flies.
#include <gtest/gtest.h>

#include "tests/actors/failsafe/flights.hpp"

namespace {

using namespace godwit::failsafe;
using namespace godwit::tests;
using godwit::vehicle_link::command_verdict;

TEST(failsafe_core, it_acts_while_the_mission_is_paused) {
  auto world = fenced();
  world.tell(expect_mode{mode_kind::hold, 5'000});
  world.mode = in_hold;
  world.run_s(10);
  EXPECT_EQ(world.pilots_seen, 0);
  world.east_m = 101;
  world.run_s(1);
  EXPECT_EQ(actions_of(world), these{action::return_home});
}

TEST(failsafe_core, it_acts_while_the_executor_is_dead) {
  flight_world world; // nobody ever said a word but vehicle and ground
  drain_to(world, 10);
  EXPECT_EQ(actions_of(world).back(), action::land);
}

TEST(failsafe_core, after_a_takeover_it_only_warns) {
  auto world = fenced();
  world.mode = in_manual;
  world.run_s(2);
  EXPECT_EQ(world.pilots_seen, 1);
  world.east_m = 500;
  world.operator_there = false;
  drain_to(world, 5);
  world.run_s(60);
  EXPECT_TRUE(world.sent.empty());
  EXPECT_TRUE(
      world.has_warned_of("a fence is breached: it is outside of all inclusion fences; a pilot has the vehicle"));
  EXPECT_TRUE(world.has_warned_of("the battery is at 5 %; a pilot"));
  EXPECT_TRUE(world.has_warned_of("lost; a pilot"));
}

TEST(failsafe_core, a_takeover_that_the_executor_saw_counts_as_well) {
  auto world = fenced();
  world.tell(taken_over{});
  world.east_m = 500;
  world.run_s(20);
  EXPECT_TRUE(world.sent.empty());
}

TEST(failsafe_core, it_never_fights_a_pilot_who_ends_its_own_return) {
  auto world = fenced();
  world.east_m = 101;
  world.run_s(5);
  EXPECT_EQ(world.mode, in_return);
  world.mode = in_manual;
  world.run_s(60);
  EXPECT_EQ(world.sent.size(), 1U);
  EXPECT_EQ(world.mode, in_manual);
}

TEST(failsafe_core, it_stops_trying_when_a_pilot_takes_over) {
  auto world = fenced();
  world.refuses = command_verdict::refused;
  world.east_m = 101;
  world.run_s(5);
  EXPECT_GT(world.sent.size(), 10U);
  world.mode = in_manual;
  world.run_s(1);
  const auto sent = world.sent.size();
  world.run_s(60);
  EXPECT_EQ(world.sent.size(), sent);
}

TEST(failsafe_core, handed_back_it_acts_on_what_still_holds) {
  auto world = fenced();
  world.mode = in_manual;
  world.run_s(2);
  world.east_m = 101;
  world.run_s(20);
  EXPECT_TRUE(world.sent.empty());
  world.tell(hand_back{});
  world.run_s(1);
  EXPECT_EQ(actions_of(world), these{action::return_home});
}

TEST(failsafe_core, handed_back_it_leaves_alone_what_is_over) {
  auto world = fenced();
  world.mode = in_manual;
  world.run_s(2);
  world.east_m = 101;
  world.run_s(2);
  world.east_m = 0;
  world.run_s(2);
  world.tell(hand_back{});
  world.tell(expect_mode{mode_kind::mission, 5'000});
  world.run_ms(100);
  world.mode = in_mission;
  world.run_s(60);
  EXPECT_TRUE(world.sent.empty());
  EXPECT_EQ(world.pilots_seen, 1);
}

TEST(failsafe_core, of_a_takeover_and_a_hand_back_in_one_tick_the_takeover_counts) {
  for (const bool takeover_first : {false, true}) {
    auto world = fenced();
    if (takeover_first)
      world.tell(taken_over{});
    world.tell(hand_back{});
    if (!takeover_first)
      world.tell(taken_over{});
    world.east_m = 101;
    world.run_s(10);
    EXPECT_TRUE(world.sent.empty());
  }
}

TEST(failsafe_core, a_takeover_that_is_told_after_the_landing_is_about_a_flight_that_has_ended) {
  auto world = fenced();
  world.armed = false;
  world.landed = landed_state::on_ground;
  world.run_s(2);
  world.tell(taken_over{});
  world.run_s(2);
  world.armed = true;
  world.landed = landed_state::in_air;
  world.run_s(2);
  world.east_m = 101;
  world.run_s(1);
  EXPECT_EQ(world.sent.size(), 1U);
}

TEST(failsafe_core, a_command_of_the_executor_that_was_on_its_way_is_answered_with_the_same_again) {
  auto world = fenced();
  world.tell(expect_mode{mode_kind::mission, 5'000});
  world.east_m = 101;
  world.run_ms(1'500);
  EXPECT_EQ(world.mode, in_return);
  world.mode = in_mission; // it arrives now
  world.run_s(10);
  EXPECT_EQ(actions_of(world), (these{action::return_home, action::return_home}));
  EXPECT_EQ(world.pilots_seen, 0);
  EXPECT_EQ(world.mode, in_return);
}

TEST(failsafe_core, once_it_has_acted_a_mode_into_which_the_plan_leads_is_a_pilots) {
  auto world = fenced();
  world.tell(expect_mode{mode_kind::hold, 0}); // after the last item
  world.east_m = 101;
  world.run_s(5);
  world.mode = in_hold;
  world.run_s(20);
  EXPECT_EQ(world.sent.size(), 1U);
  EXPECT_EQ(world.pilots_seen, 1);
}

TEST(failsafe_core, where_it_is_set_so_it_acts_in_manual_flight_too) {
  flight_world world(vehicle_class::multirotor, {.failsafe_in_manual = true});
  world.run_s(5);
  world.mode = in_manual;
  world.run_s(5);
  drain_to(world, 20);
  EXPECT_EQ(actions_of(world), these{action::return_home});
}

} // namespace
