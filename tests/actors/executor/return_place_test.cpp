// Where a return leads after a landing on the way: by the vehicle's own words, and by its track.
#include "actors/executor/flight/return_place.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "programs/godwit-sim/vehicle/world/position.hpp"
#include "tests/actors/executor/flight_checks.hpp"
#include "tests/actors/executor/flight_world.hpp"

namespace godwit::executor {
namespace return_place_test {

using mission::progress_kind;
using operators::command_kind;
using sim::personality;
using tests::flight_world;
using tests::is_told;

constexpr std::uint16_t do_set_home = 179;
constexpr std::uint32_t home_position = 242;
constexpr double at_home_m = 15;

mission::land drop_at(const mission::item& place) {
  auto at = std::get<mission::waypoint>(place).at;
  at.altitude_m = 0;
  return {"drop", at};
}

// Out, down on the ground far from home, and on from there.
mission::document with_drop(personality who) {
  auto result = tests::short_mission(who);
  const bool drives = who == personality::rover;
  const auto w2 = tests::place(who, "w2", 60, 60);
  result.items.clear();
  if (!drives)
    result.items.emplace_back(mission::takeoff{"up", 20});
  result.items.push_back(tests::place(who, "w1", 60, 0));
  if (who == personality::plane)
    result.items.push_back(w2);
  result.items.emplace_back(drop_at(who == personality::plane ? tests::place(who, "", 60, 120) : w2));
  if (!drives)
    result.items.emplace_back(mission::takeoff{"up again", 20});
  result.items.push_back(tests::place(who, "w3", 0, 60));
  if (!drives)
    result.items.push_back(tests::way_home(who));
  return result;
}

double from_home_m(const sim::position& where) { return between(where, sim::vehicle_settings{}.home).distance_m; }

double told_home_off_m(const flight_world& world) {
  const auto& home = *world.told_home();
  return from_home_m({home.latitude, home.longitude, home.above_sea_m});
}

class after_a_landing : public testing::TestWithParam<personality> {
protected:
  after_a_landing() : world({.who = GetParam(), .takeoff_again = start_policy::on_command}) {}

  void fly_to_the_landing() {
    world.load(with_drop(GetParam()));
    ASSERT_TRUE(world.run_until([&] { return is_told(world, progress_kind::reached, "drop"); }, 900)) << world.story();
    ASSERT_TRUE(world.run_until_phase(phase::ready, 120)) << world.story();
  }
  void take_off_again() {
    ASSERT_NO_FATAL_FAILURE(fly_to_the_landing());
    ASSERT_TRUE(world.say(command_kind::start).is_taken) << world.story();
    ASSERT_TRUE(world.run_until_phase(phase::flying, 60)) << world.story();
  }
  [[nodiscard]] double away_m() { return from_home_m(world.vehicle().describe().where); }
  [[nodiscard]] bool returned_by_mode() const {
    return std::ranges::any_of(world.reactions(),
                               [](const auto& each) { return each.what == failsafe::action::return_home; });
  }

  flight_world world;
};
class after_a_landing_in_the_air : public after_a_landing {};
class after_a_landing_with_a_command : public after_a_landing {};
class after_a_landing_with_an_item : public after_a_landing {};

TEST_P(after_a_landing, home_is_that_of_the_mission_again_and_the_flight_is_not_held) {
  ASSERT_NO_FATAL_FAILURE(take_off_again());
  world.run_for(4);
  EXPECT_LT(told_home_off_m(world), 1) << world.story();
  EXPECT_EQ(world.durable().status.now, phase::flying) << world.story();
  EXPECT_GT(away_m(), 30) << "else it shows nothing";
  ASSERT_TRUE(world.run_until([&] { return is_over(world.durable().status.now); }, 900)) << world.story();
  EXPECT_EQ(world.reports().back().kind, progress_kind::complete) << world.story();
}

TEST_P(after_a_landing_in_the_air, who_is_called_home_lands_at_the_home_of_the_mission) {
  ASSERT_NO_FATAL_FAILURE(take_off_again());
  world.run_for(4);
  ASSERT_TRUE(world.say(command_kind::come_home).is_taken);
  ASSERT_TRUE(world.run_until([&] { return !world.vehicle().describe().armed; }, 300)) << world.story();
  EXPECT_LT(away_m(), at_home_m) << world.story();
}

TEST_P(after_a_landing_in_the_air, a_failsafes_return_leads_to_the_home_of_the_mission) {
  ASSERT_NO_FATAL_FAILURE(take_off_again());
  world.run_for(4);
  world.vehicle().set_battery(22, world.now_ns());
  ASSERT_TRUE(world.run_until([&] { return !world.vehicle().describe().armed; }, 300)) << world.story();
  EXPECT_TRUE(returned_by_mode()) << world.story();
  EXPECT_LT(away_m(), at_home_m) << world.story();
}

TEST_P(after_a_landing, where_home_is_moved_people_are_told_and_it_is_called_home_by_a_plan) {
  ASSERT_NO_FATAL_FAILURE(take_off_again());
  world.run_for(4);
  world.set_home_by_hand();
  ASSERT_TRUE(world.run_until([&] { return !world.home_moved().empty(); }, 10)) << world.story();
  EXPECT_NE(world.home_moved().find("from the home of the mission"), std::string::npos) << world.story();
  if (GetParam() == personality::plane)
    return; // has no way to end a plan there that needs no runway
  world.run_for(2);
  ASSERT_TRUE(world.say(command_kind::come_home).is_taken) << world.story();
  ASSERT_TRUE(world.run_until([&] { return is_over(world.durable().status.now); }, 300)) << world.story();
  EXPECT_LT(away_m(), at_home_m) << world.story();
}

TEST_P(after_a_landing_in_the_air, where_home_is_moved_a_failsafes_return_leads_to_the_home_of_the_mission_by_a_plan) {
  ASSERT_NO_FATAL_FAILURE(take_off_again());
  world.run_for(4);
  world.set_home_by_hand();
  ASSERT_TRUE(world.run_until([&] { return !world.home_moved().empty(); }, 10)) << world.story();
  world.vehicle().set_battery(22, world.now_ns());
  ASSERT_TRUE(world.run_until([&] { return !world.vehicle().describe().armed; }, 300)) << world.story();
  EXPECT_FALSE(returned_by_mode()) << world.story();
  EXPECT_LT(away_m(), at_home_m) << world.story();
}

TEST_P(after_a_landing_with_a_command, without_its_home_it_does_not_take_off) {
  ASSERT_NO_FATAL_FAILURE(fly_to_the_landing());
  world.vehicle().refuse_command(do_set_home, 2, -1);
  ASSERT_TRUE(world.say(command_kind::start).is_taken);
  ASSERT_TRUE(world.run_until_phase(phase::paused, 60)) << world.story();
  EXPECT_NE(world.durable().status.reason.find("home"), std::string::npos) << world.story();
  world.run_for(30);
  EXPECT_FALSE(world.vehicle().describe().armed) << world.story();
}

TEST_P(after_a_landing_with_a_command, where_home_is_not_told_it_does_not_take_off) {
  ASSERT_NO_FATAL_FAILURE(fly_to_the_landing());
  world.lose_message(home_position);
  ASSERT_TRUE(world.say(command_kind::start).is_taken);
  ASSERT_TRUE(world.run_until_phase(phase::paused, 60)) << world.story();
  world.run_for(30);
  EXPECT_FALSE(world.vehicle().describe().in_air) << world.story();
  EXPECT_FALSE(world.vehicle().describe().armed) << world.story();
}

TEST_P(after_a_landing_with_a_command, its_home_is_free_again_after_the_mission) {
  ASSERT_NO_FATAL_FAILURE(take_off_again());
  EXPECT_TRUE(world.durable().has_commanded_home);
  ASSERT_TRUE(world.run_until([&] { return is_over(world.durable().status.now); }, 900)) << world.story();
  ASSERT_TRUE(world.run_until([&] { return !world.durable().has_commanded_home; }, 60)) << world.story();
  EXPECT_EQ(std::ranges::count(world.commands(), do_set_home), 2) << world.story();
}

TEST_P(after_a_landing_with_a_command, its_home_is_freed_by_who_comes_after_a_kill) {
  ASSERT_NO_FATAL_FAILURE(take_off_again());
  ASSERT_TRUE(world.run_until([&] { return is_over(world.durable().status.now); }, 900)) << world.story();
  world.crash_all();
  ASSERT_TRUE(world.run_until([&] { return !world.durable().has_commanded_home; }, 60)) << world.story();
}

TEST_P(after_a_landing_with_an_item, where_home_is_not_told_it_holds_and_is_called_home_by_a_plan) {
  ASSERT_NO_FATAL_FAILURE(fly_to_the_landing());
  world.lose_message(home_position);
  ASSERT_TRUE(world.say(command_kind::start).is_taken);
  ASSERT_TRUE(world.run_until_phase(phase::flying, 60)) << world.story();
  ASSERT_TRUE(world.run_until_phase(phase::paused, 10)) << world.story();
  EXPECT_NE(world.durable().status.reason.find("does not report where its home is"), std::string::npos)
      << world.story();
  world.run_for(3);
  ASSERT_TRUE(world.say(command_kind::come_home).is_taken);
  ASSERT_TRUE(world.run_until([&] { return !world.vehicle().describe().armed; }, 300)) << world.story();
  EXPECT_LT(away_m(), at_home_m) << world.story();
  EXPECT_TRUE(world.durable().progress.plan && progress::is_way_home(world.durable().progress.plan->map))
      << world.story();
}

TEST_P(after_a_landing_with_an_item, no_command_locks_its_home) {
  ASSERT_NO_FATAL_FAILURE(take_off_again());
  EXPECT_EQ(std::ranges::count(world.commands(), do_set_home), 0) << world.story();
  EXPECT_EQ(world.durable().flown->items.at(1).command, do_set_home);
}

TEST_P(after_a_landing, an_executor_that_dies_in_the_second_flight_looks_at_home_again_and_flies_on) {
  ASSERT_NO_FATAL_FAILURE(take_off_again());
  world.run_for(0.5);
  world.crash();
  world.run_for(4);
  EXPECT_EQ(world.durable().status.now, phase::flying) << world.story();
  ASSERT_TRUE(world.run_until([&] { return is_over(world.durable().status.now); }, 900)) << world.story();
}

std::string name_of(const testing::TestParamInfo<personality>& each) { return std::string(io::name_of(each.param)); }

INSTANTIATE_TEST_SUITE_P(each, after_a_landing,
                         testing::Values(personality::rover, personality::px4, personality::ardupilot,
                                         personality::plane),
                         name_of);
INSTANTIATE_TEST_SUITE_P(each, after_a_landing_in_the_air, testing::Values(personality::px4, personality::ardupilot),
                         name_of);
INSTANTIATE_TEST_SUITE_P(each, after_a_landing_with_a_command, testing::Values(personality::px4), name_of);
INSTANTIATE_TEST_SUITE_P(each, after_a_landing_with_an_item, testing::Values(personality::ardupilot), name_of);

} // namespace return_place_test
} // namespace godwit::executor
