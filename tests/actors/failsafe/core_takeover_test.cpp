// The core: who flies.
#include <algorithm>

#include <gtest/gtest.h>

#include "tests/actors/failsafe/flights.hpp"

namespace core_takeover_test {

using namespace godwit::failsafe;
using namespace godwit::tests;
using godwit::mission::fence_kind;
using godwit::vehicle_link::command_verdict;

constexpr std::uint16_t last_item = 6;

// On its mission, after whose last item the vehicle changes its mode.
flight_world ends_in(const flight_mode& mode) {
  flight_world world;
  world.set_fences({fence_of(fence_kind::inclusion, square(100))}, {}, {last_item, false, {mode.custom_mode}});
  world.run_s(10);
  return world;
}

TEST(failsafe_core, it_acts_while_the_mission_is_paused) {
  auto world = fenced();
  world.tell(expect_mode{{in_hold.custom_mode}, 5'000});
  world.mode = in_hold;
  world.run_s(10);
  EXPECT_EQ(world.pilots_seen, 0);
  world.east_m = 101;
  world.run_s(1);
  EXPECT_EQ(actions_of(world), these{action::return_home});
}

TEST(failsafe_core, a_hold_by_loiter_where_brake_was_ordered_is_a_pilot) {
  auto world = fenced();
  world.tell(expect_mode{{in_hold.custom_mode}, 5'000});
  world.mode = in_loiter;
  world.run_s(2);
  EXPECT_EQ(world.pilots_seen, 1);
  world.east_m = 101;
  world.run_s(10);
  EXPECT_TRUE(world.sent.empty());
}

// As a real PX4 does it, in the return that the executor has ordered: a pilot was reported after its landing.
TEST(failsafe_core, a_vehicle_that_bounces_as_it_touches_down_in_a_return_of_ours_is_nobodys) {
  flight_world world;
  world.run_s(5);
  world.tell(expect_mode{{in_return.custom_mode}, 5'000});
  world.mode = in_return;
  world.run_s(5);
  world.landed = landed_state::on_ground;
  world.run_s(3);
  EXPECT_FALSE(world.told().in_flight);
  world.landed = landed_state::landing;
  world.run_s(1);
  EXPECT_TRUE(world.told().in_flight);
  world.landed = landed_state::on_ground;
  world.run_s(5);
  EXPECT_EQ(world.pilots_seen, 0);
}

// A plane with RTL_AUTOLAND 2: RTL, and some milliseconds later AUTO with a text.
class plane_on_its_way_home : public testing::TestWithParam<bool> {};

TEST_P(plane_on_its_way_home, lands_by_its_plan_and_is_a_pilots_only_without_its_word) {
  using godwit::io::mavlink::mav_autopilot;
  const auto beat = [](flight_world& world, const flight_mode& mode) {
    world.tell(heartbeat{vehicle_class::fixed_wing, true, mode, mav_autopilot::ardupilotmega});
    world.run_ms(100); // it is looked at
  };
  flight_world world(vehicle_class::fixed_wing);
  world.sends_heartbeats = false;
  const flight_mode in_auto{mode_kind::mission, 10};
  beat(world, in_auto);
  world.tell(landed{landed_state::in_air});
  for (int i = 0; i < 20; ++i)
    beat(world, in_auto);
  ASSERT_EQ(world.pilots_seen, 0);
  world.tell(expect_mode{{11}, 5'000});
  beat(world, {mode_kind::returning, 11});
  world.tell(heartbeat{vehicle_class::fixed_wing, true, in_auto, mav_autopilot::ardupilotmega});
  const bool has_said_so = GetParam();
  if (has_said_so)
    world.tell(autopilot_text{"Landing sequence start"});
  for (int i = 0; i < 20; ++i)
    beat(world, in_auto);
  EXPECT_EQ(world.pilots_seen, has_said_so ? 0 : 1);
}

INSTANTIATE_TEST_SUITE_P(its_word, plane_on_its_way_home, testing::Bool());

TEST(failsafe_core, a_mode_that_is_told_between_two_heartbeats_is_a_pilots) {
  auto world = fenced();
  world.run_ms(200);
  world.tell(modes_told{in_manual.custom_mode, in_manual.custom_mode});
  world.run_ms(100);
  EXPECT_EQ(world.pilots_seen, 1);
  world.east_m = 101;
  world.run_ms(500);
  EXPECT_TRUE(world.sent.empty());
}

TEST(failsafe_core, a_change_of_the_actual_mode_alone_is_the_autopilots_own_failsafe) {
  auto world = fenced();
  world.run_ms(200);
  world.tell(modes_told{in_mission.custom_mode, in_mission.custom_mode});
  world.run_ms(200);
  world.tell(modes_told{in_hold.custom_mode, in_mission.custom_mode});
  world.mode = in_hold;
  world.run_s(5);
  EXPECT_EQ(std::ranges::count_if(world.warnings,
                                  [](const std::string& each) {
                                    return each.find("the autopilot's own failsafe has the vehicle") !=
                                           std::string::npos;
                                  }),
            1);
}

TEST(failsafe_core, an_order_that_was_seen_to_be_obeyed_between_two_heartbeats_is_so_after_a_restart) {
  auto world = fenced();
  world.run_ms(200);
  world.tell(expect_mode{{in_return.custom_mode}, 5'000});
  world.tell(modes_told{in_return.custom_mode, in_return.custom_mode});
  world.run_ms(100);
  world.mode = in_return;
  world.restart();
  world.run_s(2);
  EXPECT_EQ(world.pilots_seen, 0);
}

TEST(failsafe_core, a_mode_that_was_told_before_a_heartbeat_is_not_judged_after_it) {
  auto world = fenced();
  world.tell(expect_mode{{in_hold.custom_mode}, 5'000});
  world.mode = in_hold;
  world.tell(modes_told{in_mission.custom_mode, in_mission.custom_mode}); // the heartbeat is of the same tick
  world.run_s(2);
  EXPECT_EQ(world.pilots_seen, 0);
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

TEST(failsafe_core, a_takeover_is_told_once_by_whichever_way_it_is_learned) {
  auto world = fenced();
  world.mode = in_manual;
  world.run_s(5);
  world.tell(taken_over{});
  world.tell(taken_over{});
  world.run_s(5);
  EXPECT_EQ(
      std::count_if(world.warnings.begin(), world.warnings.end(),
                    [](const std::string& each) { return each.find("the failsafes only warn") != std::string::npos; }),
      1);
}

TEST(failsafe_core, a_command_of_somebody_else_is_a_takeover_and_a_plan_that_he_brings_is_none) {
  for (const auto kind : {godwit::vehicle_link::foreign_kind::command, godwit::vehicle_link::foreign_kind::plan}) {
    auto world = fenced();
    godwit::vehicle_link::foreign_act act;
    act.kind = kind;
    world.tell(act);
    world.run_s(1);
    world.east_m = 101;
    world.run_s(2);
    EXPECT_EQ(world.sent.empty(), kind == godwit::vehicle_link::foreign_kind::command);
  }
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
  world.tell(expect_mode{{in_mission.custom_mode}, 5'000});
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

TEST(failsafe_core, a_takeover_that_is_told_on_the_ground_counts_in_the_air_until_a_hand_back) {
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
  EXPECT_TRUE(world.sent.empty());
  world.tell(hand_back{});
  world.run_s(1);
  EXPECT_EQ(world.sent.size(), 1U);
}

TEST(failsafe_core, a_command_of_the_executor_that_comes_after_its_own_is_answered_with_the_same_again) {
  auto world = fenced();
  world.east_m = 101;
  world.run_ms(300);
  ASSERT_EQ(world.sent.size(), 1U);
  world.tell(expect_mode{{in_mission.custom_mode}, 5'000}); // said before it has heard of the return
  world.run_ms(1'400);
  EXPECT_EQ(world.mode, in_return);
  world.mode = in_mission; // it arrives now
  world.run_s(10);
  EXPECT_EQ(actions_of(world), (these{action::return_home, action::return_home}));
  EXPECT_EQ(world.pilots_seen, 0);
  EXPECT_EQ(world.mode, in_return);
}

TEST(failsafe_core, a_command_of_the_executor_that_its_own_has_overtaken_is_expected_no_more) {
  auto world = fenced();
  world.tell(expect_mode{{in_mission.custom_mode}, 5'000});
  world.east_m = 101;
  world.run_ms(1'500);
  EXPECT_EQ(world.mode, in_return);
  world.mode = in_mission;
  world.run_s(10);
  EXPECT_EQ(world.sent.size(), 1U);
  EXPECT_EQ(world.pilots_seen, 1);
}

// -- the end of the plan ---------------------------------------------------------------------------

TEST(failsafe_core, on_the_way_to_the_last_item_a_hold_is_a_pilots_and_a_low_battery_only_warns) {
  auto world = ends_in(in_hold);
  world.sequence = last_item;
  world.run_s(2);
  world.mode = in_hold;
  world.run_s(3);
  EXPECT_EQ(world.pilots_seen, 1);
  EXPECT_TRUE(world.has_warned_of("the mode was changed by somebody else"));
  drain_to(world, 20);
  EXPECT_TRUE(world.sent.empty());
  EXPECT_TRUE(world.has_warned_of("the battery is at 20 %; a pilot has the vehicle, nothing is sent"));
}

TEST(failsafe_core, at_the_end_of_the_plan_its_hold_is_nobodys_takeover_and_it_still_acts) {
  for (const bool told_before : {false, true}) {
    auto world = ends_in(in_hold);
    world.sequence = last_item;
    world.is_complete = told_before;
    world.run_s(2);
    world.is_complete = true;
    world.mode = in_hold;
    world.run_s(60);
    EXPECT_EQ(world.pilots_seen, 0);
    EXPECT_TRUE(world.sent.empty());
    drain_to(world, 20);
    EXPECT_EQ(actions_of(world), these{action::return_home});
    EXPECT_EQ(world.mode, in_return);
    EXPECT_EQ(world.pilots_seen, 0);
  }
}

TEST(failsafe_core, who_takes_the_vehicle_at_the_end_of_the_plan_is_a_pilot) {
  for (const auto& mode : {in_loiter, in_manual, in_return}) {
    auto world = ends_in(in_hold);
    world.sequence = last_item;
    world.is_complete = true;
    world.mode = in_hold;
    world.run_s(5);
    world.mode = mode;
    world.run_s(2);
    EXPECT_EQ(world.pilots_seen, 1);
    world.east_m = 101;
    world.run_s(10);
    EXPECT_TRUE(world.sent.empty());
  }
}

// A breach while nobody knows whose the hold is: decided, and not sent.
flight_world unclear() {
  auto world = ends_in(in_hold);
  world.sends_sequence = false;
  world.sequence = last_item;
  world.mode = in_hold;
  world.run_s(1);
  world.east_m = 101;
  world.run_s(2);
  EXPECT_EQ(world.acted.size(), 1U);
  EXPECT_TRUE(world.sent.empty());
  EXPECT_EQ(world.pilots_seen, 0);
  return world;
}

TEST(failsafe_core, while_it_is_unclear_whose_the_mode_is_nothing_is_sent_and_at_the_end_of_the_plan_it_is_then) {
  auto world = unclear();
  world.is_complete = true;
  world.sends_sequence = true;
  world.run_ms(100);
  EXPECT_EQ(actions_of(world), these{action::return_home});
  world.run_s(30);
  EXPECT_EQ(world.sent.size(), 1U);
  EXPECT_EQ(world.mode, in_return);
  EXPECT_EQ(world.pilots_seen, 0);
}

TEST(failsafe_core, what_was_unclear_and_is_not_the_end_of_the_plan_is_a_pilots_and_nothing_is_sent) {
  for (const bool is_told : {false, true}) {
    auto world = unclear();
    world.sends_sequence = is_told;
    world.run_s(30);
    EXPECT_TRUE(world.sent.empty());
    EXPECT_EQ(world.mode, in_hold);
    EXPECT_EQ(world.pilots_seen, 1);
    EXPECT_TRUE(world.has_warned_of("the mode was changed by somebody else"));
  }
}

TEST(failsafe_core, on_the_ground_that_was_unclear_is_forgotten) {
  auto world = unclear();
  world.armed = false;
  world.landed = landed_state::on_ground;
  world.run_s(10);
  EXPECT_EQ(world.pilots_seen, 0);
  EXPECT_TRUE(world.sent.empty());
}

TEST(failsafe_core, once_it_has_acted_a_mode_into_which_the_plan_leads_is_a_pilots) {
  for (const bool starts_again : {false, true}) {
    auto world = ends_in(in_loiter);
    world.sequence = last_item;
    world.is_complete = true;
    world.east_m = 101;
    world.run_s(5);
    EXPECT_EQ(world.mode, in_return);
    if (starts_again)
      world.restart();
    world.mode = in_loiter;
    world.run_s(20);
    EXPECT_EQ(world.sent.size(), 1U) << starts_again;
    EXPECT_EQ(world.pilots_seen, 1) << starts_again;
  }
}

// -- after its own return -------------------------------------------------------------------------

// At home, or because a person says so: by its mode alone nobody can tell.
TEST(failsafe_core, a_hold_that_follows_the_return_is_not_answered_with_the_same_again) {
  for (const auto what : {vehicle_class::multirotor, vehicle_class::rover}) {
    flight_world world(what);
    world.run_s(5);
    drain_to(world, 20);
    ASSERT_EQ(actions_of(world), these{action::return_home});
    EXPECT_EQ(world.mode, world.in(mode_kind::returning));
    world.mode = world.in(mode_kind::hold);
    world.run_s(30);
    EXPECT_EQ(world.sent.size(), 1U);
    EXPECT_EQ(world.mode, world.in(mode_kind::hold));
  }
}

// -- as it is set ----------------------------------------------------------------------------------

TEST(failsafe_core, where_it_is_set_so_it_acts_in_manual_flight_too) {
  flight_world world(vehicle_class::multirotor, {.failsafe_in_manual = true});
  world.run_s(5);
  world.mode = in_manual;
  world.run_s(5);
  drain_to(world, 20);
  EXPECT_EQ(actions_of(world), these{action::return_home});
}

} // namespace core_takeover_test
