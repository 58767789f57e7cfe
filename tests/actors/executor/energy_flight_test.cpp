// What people are told of the battery, before and in flights whose vehicle drains it in real time.
#include <algorithm>

#include <gtest/gtest.h>

#include "tests/actors/executor/flight_world.hpp"

namespace godwit::executor {
namespace energy_flight_test {

using operators::command_kind;
using sim::personality;
using tests::flight_world;

// Up to 400 m from home, to and fro for a quarter of an hour.
mission::document long_mission(personality who) {
  auto result = tests::short_mission(who);
  const double up_m = who == personality::rover ? 0 : 20;
  result.items.resize(who == personality::rover ? 0 : 1); // the take-off
  for (int i = 0; i < 20; ++i)
    result.items.push_back(tests::place("p" + std::to_string(i), i % 2 == 0 ? 400 : 300, i * 5.0, up_m));
  return result;
}

int warnings_in(const flight_world& world) {
  return static_cast<int>(std::ranges::count_if(
      world.said(), [](const std::string& each) { return each.find("just for the way home") != std::string::npos; }));
}

class energy_flight : public testing::TestWithParam<personality> {};

TEST_P(energy_flight, a_battery_that_lasts_just_for_the_way_home_is_told_once_before_the_failsafe_returns) {
  flight_world world({.who = GetParam(), .speed = 1, .battery_percent = 70, .endurance_s = 700});
  world.load(long_mission(GetParam()));
  ASSERT_TRUE(world.run_until([&] { return warnings_in(world) > 0; }, 900)) << world.story();
  EXPECT_TRUE(world.reactions().empty()) << world.story();
  EXPECT_EQ(world.durable().status.now, phase::flying) << "nothing is flown because of it";
  ASSERT_TRUE(world.run_until([&] { return !world.reactions().empty(); }, 900)) << world.story();
  EXPECT_EQ(warnings_in(world), 1) << world.story();
}

TEST_P(energy_flight, a_battery_that_lasts_is_not_spoken_of) {
  flight_world world({.who = GetParam(), .speed = 1, .battery_percent = 90, .endurance_s = 7'000});
  world.load(tests::short_mission(GetParam()));
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  EXPECT_EQ(warnings_in(world), 0) << world.story();
}

TEST_P(energy_flight, one_that_does_not_last_for_the_plan_is_acknowledged_before_the_flight) {
  flight_world world({.who = GetParam(), .drain_percent_per_min = 20});
  world.load(long_mission(GetParam()));
  ASSERT_TRUE(world.run_until([&] { return world.durable().preflight.now == preflight::phase::awaiting_ack; }, 60))
      << world.story();
  operators::command yes;
  yes.kind = command_kind::acknowledge;
  yes.report = world.durable().preflight.report->id;
  ASSERT_TRUE(world.say(yes).is_taken) << world.story();
  EXPECT_TRUE(world.run_until_phase(phase::flying, 60)) << world.story();
}

TEST_P(energy_flight, one_that_lasts_for_the_plan_by_the_drain_that_was_set_needs_no_word) {
  flight_world world({.who = GetParam(), .drain_percent_per_min = 1});
  world.load(tests::short_mission(GetParam()));
  EXPECT_TRUE(world.run_until_phase(phase::flying, 60)) << world.story();
}

TEST_P(energy_flight, what_the_way_home_needs_is_told_in_flight_and_why_it_is_not_known) {
  flight_world world({.who = GetParam(), .speed = 1, .battery_percent = 90, .endurance_s = 700});
  EXPECT_FALSE(world.way_home().needs_percent);
  world.load(long_mission(GetParam()));
  ASSERT_TRUE(world.run_until([&] { return world.way_home().left_percent == 90; }, 60)) << "on the ground";
  EXPECT_FALSE(world.way_home().needs_percent);
  EXPECT_EQ(world.way_home().why_not_known, "the vehicle is not under way");
  ASSERT_TRUE(world.run_until([&] { return world.way_home().why_not_known.find("drains") != std::string::npos; }, 60))
      << world.story();
  ASSERT_TRUE(world.run_until([&] { return world.way_home().needs_percent.has_value(); }, 300)) << world.story();
  EXPECT_EQ(world.way_home().why_not_known, "");
  ASSERT_TRUE(world.run_until([&] { return warnings_in(world) > 0; }, 900)) << world.story();
  const auto now = world.way_home();
  ASSERT_TRUE(now.needs_percent && now.left_percent && now.spare_percent);
  EXPECT_LE(*now.spare_percent, 0.5) << "it is the figure by which people were warned";
  EXPECT_NEAR(*now.left_percent - now.reserve_percent - *now.needs_percent, *now.spare_percent, 1e-9);
  EXPECT_GT(*now.needs_percent, 5) << "hundreds of metres, of a battery that lasts for 700 s";
}

TEST_P(energy_flight, by_the_drain_that_is_set_the_way_home_is_known_from_the_take_off_on) {
  flight_world world({.who = GetParam(), .drain_percent_per_min = 3});
  world.load(tests::short_mission(GetParam()));
  ASSERT_TRUE(world.run_until([&] { return world.way_home().needs_percent.has_value(); }, 90)) << world.story();
  EXPECT_LT(*world.way_home().needs_percent, 10);
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  EXPECT_FALSE(world.way_home().needs_percent) << "it is down";
}

INSTANTIATE_TEST_SUITE_P(vehicles, energy_flight, testing::Values(personality::px4, personality::ardupilot),
                         [](const auto& who) { return std::string(io::name_of(who.param)); });

} // namespace energy_flight_test
} // namespace godwit::executor
