// What people are told of a vehicle that should move and does not.
#include <algorithm>

#include <gtest/gtest.h>

#include "tests/actors/executor/flight_world.hpp"

namespace godwit::executor {
namespace standstill_test {

using sim::personality;
using tests::flight_world;

int warnings_in(const flight_world& world) {
  return static_cast<int>(std::ranges::count_if(
      world.said(), [](const std::string& each) { return each.find("has not moved for 6") != std::string::npos; }));
}

mission::document far_place(personality who, double hold_s) {
  auto result = tests::short_mission(who);
  const double up_m = who == personality::rover ? 0 : 20;
  result.items.resize(who == personality::rover ? 0 : 1); // the take-off
  result.items.push_back(tests::place("near", 20, 0, up_m));
  std::get<mission::waypoint>(result.items.back()).hold_s = hold_s;
  result.items.push_back(tests::place("far", 200, 0, up_m));
  result.items.push_back(drill::way_home(who));
  return result;
}

class standstill : public testing::TestWithParam<personality> {};

TEST_P(standstill, people_are_told_once_of_a_vehicle_in_its_mission_mode_that_does_not_move) {
  flight_world world({.who = GetParam(), .speed = 1});
  world.load(far_place(GetParam(), 0));
  ASSERT_TRUE(world.run_until_phase(phase::flying)) << world.story();
  ASSERT_TRUE(world.run_until([&] { return world.vehicle().describe().ground_speed_mps > 1; }, 60)) << world.story();
  const auto orders = world.orders();
  world.vehicle().block(true, world.now_ns());
  ASSERT_TRUE(world.run_until([&] { return warnings_in(world) > 0; }, 90)) << world.story();
  world.run_for(200);
  EXPECT_EQ(warnings_in(world), 1) << world.story();
  EXPECT_EQ(world.orders(), orders) << "nothing is sent because of it";
  world.vehicle().block(false, world.now_ns());
  EXPECT_TRUE(world.run_until_phase(phase::done)) << world.story();
}

TEST_P(standstill, one_that_waits_as_its_plan_says_is_not_spoken_of) {
  flight_world world({.who = GetParam(), .speed = 1});
  world.load(far_place(GetParam(), 150));
  ASSERT_TRUE(world.run_until_phase(phase::done, 900)) << world.story();
  EXPECT_EQ(warnings_in(world), 0) << world.story();
}

INSTANTIATE_TEST_SUITE_P(hovering_and_driving, standstill,
                         testing::Values(personality::px4, personality::ardupilot, personality::rover),
                         [](const auto& each) { return std::string(io::name_of(each.param)); });

} // namespace standstill_test
} // namespace godwit::executor
