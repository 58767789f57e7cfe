// Somebody moves the vehicle's home in the first flight of a mission: whose return leads where, by the track.
#include <algorithm>

#include <gtest/gtest.h>

#include "programs/godwit-sim/vehicle/world/position.hpp"
#include "tests/actors/executor/flight_world.hpp"

namespace godwit::executor {
namespace home_moved_test {

using operators::command_kind;
using sim::personality;
using tests::flight_world;

constexpr double at_home_m = 15;

class home_moved : public testing::TestWithParam<personality> {
protected:
  home_moved() : world({.who = GetParam()}) {}

  // On its way, home is put to where it is.
  void move_home() {
    world.load(tests::short_mission(GetParam()));
    ASSERT_TRUE(world.run_until([&] { return away_m() > 40; }, 300)) << world.story();
    world.set_home_by_hand();
  }
  void be_told() {
    ASSERT_TRUE(world.run_until([&] { return !world.home_moved().empty(); }, 5)) << world.story();
  }
  bool is_down() {
    const auto seen = world.vehicle().describe();
    return is_over(world.durable().status.now) && !seen.in_air;
  }
  [[nodiscard]] double away_m() {
    return between(world.vehicle().describe().where, sim::vehicle_settings{}.home).distance_m;
  }
  [[nodiscard]] bool is_said(const std::string& part) {
    return std::ranges::any_of(world.said(), [&](const auto& each) { return each.find(part) != std::string::npos; });
  }
  [[nodiscard]] bool returned_by_mode() const {
    return std::ranges::any_of(world.reactions(),
                               [](const auto& each) { return each.what == failsafe::action::return_home; });
  }

  flight_world world;
};

TEST_P(home_moved, in_flight_makes_health_red_and_is_told_with_the_distance_and_holds_nothing) {
  ASSERT_NO_FATAL_FAILURE(move_home());
  ASSERT_NO_FATAL_FAILURE(be_told());
  EXPECT_TRUE(is_said("somebody has moved the vehicle's home")) << world.story();
  EXPECT_NE(world.home_moved().find(" m from the home of the mission"), std::string::npos) << world.home_moved();
  EXPECT_EQ(world.durable().status.now, phase::flying) << world.story();
}

TEST_P(home_moved, in_flight_who_is_called_home_comes_to_the_home_of_the_mission) {
  ASSERT_NO_FATAL_FAILURE(move_home());
  ASSERT_NO_FATAL_FAILURE(be_told());
  ASSERT_TRUE(world.run_until([&] { return world.say(command_kind::come_home).is_taken; }, 20)) << world.story();
  ASSERT_TRUE(world.run_until([&] { return is_down(); }, 300)) << world.story();
  EXPECT_LT(away_m(), at_home_m) << world.story();
}

// It was called home before anybody could know of it.
TEST_P(home_moved, while_it_returns_is_noticed_and_it_comes_to_the_home_of_the_mission) {
  world.load(tests::short_mission(GetParam()));
  ASSERT_TRUE(world.run_until([&] { return away_m() > 70; }, 300)) << world.story();
  ASSERT_TRUE(world.say(command_kind::come_home).is_taken) << world.story();
  world.run_for(0.2);
  world.set_home_by_hand();
  ASSERT_TRUE(world.run_until([&] { return is_down(); }, 300)) << world.story();
  EXPECT_LT(away_m(), at_home_m) << world.story();
}

TEST_P(home_moved, the_return_with_which_the_mission_ends_leads_to_the_home_of_the_mission) {
  if (GetParam() == personality::rover)
    return; // its mission ends where it is
  ASSERT_NO_FATAL_FAILURE(move_home());
  ASSERT_TRUE(world.run_until([&] { return is_down(); }, 600)) << world.story();
  EXPECT_LT(away_m(), at_home_m) << world.story();
  EXPECT_EQ(world.reports().back().kind, mission::progress_kind::complete) << world.story();
}

TEST_P(home_moved, a_failsafes_return_leads_to_the_home_of_the_mission_by_a_plan_of_the_executor) {
  ASSERT_NO_FATAL_FAILURE(move_home());
  ASSERT_NO_FATAL_FAILURE(be_told());
  world.vehicle().set_battery(22, world.now_ns());
  ASSERT_TRUE(world.run_until([&] { return is_down(); }, 300)) << world.story();
  EXPECT_FALSE(returned_by_mode()) << world.story();
  EXPECT_LT(away_m(), at_home_m) << world.story();
}

TEST_P(home_moved, the_home_of_the_arming_is_known_after_a_kill_of_the_process) {
  ASSERT_NO_FATAL_FAILURE(move_home());
  world.crash_all();
  ASSERT_NO_FATAL_FAILURE(be_told());
  ASSERT_TRUE(world.run_until([&] { return world.say(command_kind::come_home).is_taken; }, 20)) << world.story();
  ASSERT_TRUE(world.run_until([&] { return is_down(); }, 300)) << world.story();
  EXPECT_LT(away_m(), at_home_m) << world.story();
}

TEST_P(home_moved, and_back_again_is_as_if_nothing_had_been) {
  ASSERT_NO_FATAL_FAILURE(move_home());
  ASSERT_NO_FATAL_FAILURE(be_told());
  world.set_home_by_hand(sim::vehicle_settings{}.home);
  ASSERT_TRUE(world.run_until([&] { return world.home_moved().empty(); }, 5)) << world.story();
  EXPECT_TRUE(is_said("home is that of the mission again")) << world.story();
}

// Between the arming and the first word of the vehicle about its home; and before it, when the plan is there already.
TEST_P(home_moved, right_after_the_arming_is_noticed_and_who_is_called_home_comes_to_where_it_was_armed) {
  for (const bool is_before_arming : {false, true}) {
    flight_world slow({.who = GetParam(), .start = start_policy::on_command, .speed = 1});
    slow.load(tests::short_mission(GetParam()));
    ASSERT_TRUE(slow.run_until_phase(phase::ready, 120)) << slow.story();
    const auto stood = slow.vehicle().describe().where;
    const auto elsewhere = sim::moved(stood, {90, 200});
    if (is_before_arming)
      slow.set_home_by_hand(elsewhere);
    ASSERT_TRUE(slow.say(command_kind::start).is_taken);
    ASSERT_TRUE(slow.run_until([&] { return slow.vehicle().describe().armed; }, 20)) << slow.story();
    if (!is_before_arming)
      slow.set_home_by_hand(elsewhere);
    ASSERT_TRUE(slow.run_until([&] { return !slow.home_moved().empty(); }, 20)) << slow.story();
    ASSERT_TRUE(slow.run_until([&] { return between(slow.vehicle().describe().where, stood).distance_m > 20; }, 100));
    ASSERT_TRUE(slow.run_until([&] { return slow.say(command_kind::come_home).is_taken; }, 20)) << slow.story();
    ASSERT_TRUE(
        slow.run_until([&] { return is_over(slow.durable().status.now) && !slow.vehicle().describe().in_air; }, 300))
        << slow.story();
    EXPECT_LT(between(slow.vehicle().describe().where, stood).distance_m, at_home_m) << slow.story();
  }
}

TEST_P(home_moved, right_after_the_arming_a_failsafes_return_leads_to_where_it_was_armed) {
  flight_world slow({.who = GetParam(), .start = start_policy::on_command, .speed = 1});
  slow.load(tests::short_mission(GetParam()));
  ASSERT_TRUE(slow.run_until_phase(phase::ready, 120)) << slow.story();
  const auto stood = slow.vehicle().describe().where;
  ASSERT_TRUE(slow.say(command_kind::start).is_taken);
  ASSERT_TRUE(slow.run_until([&] { return slow.vehicle().describe().armed; }, 20)) << slow.story();
  slow.set_home_by_hand(sim::moved(stood, {90, 200}));
  ASSERT_TRUE(slow.run_until([&] { return between(slow.vehicle().describe().where, stood).distance_m > 20; }, 100));
  slow.vehicle().set_battery(22, slow.now_ns());
  ASSERT_TRUE(
      slow.run_until([&] { return is_over(slow.durable().status.now) && !slow.vehicle().describe().in_air; }, 300))
      << slow.story();
  EXPECT_LT(between(slow.vehicle().describe().where, stood).distance_m, at_home_m) << slow.story();
}

INSTANTIATE_TEST_SUITE_P(each, home_moved,
                         testing::Values(personality::rover, personality::px4, personality::ardupilot),
                         [](const auto& each) { return std::string(io::name_of(each.param)); });

} // namespace home_moved_test
} // namespace godwit::executor
