// A command is meant for how its sender saw the flight stand.
#include "actors/executor/state_token.hpp"

#include <gtest/gtest.h>

#include "tests/actors/executor/flight_world.hpp"

namespace godwit::executor {
namespace state_token_test {

using operators::command_kind;
using sim::personality;
using tests::flight_world;

class state_token_of : public testing::TestWithParam<personality> {};

operators::command meant_for(command_kind kind, std::string state) {
  operators::command result;
  result.kind = kind;
  result.by = "anna";
  result.state = std::move(state);
  return result;
}

TEST_P(state_token_of, a_flight_stays_while_it_flies_on_and_changes_with_each_phase) {
  flight_world world({.who = GetParam()});
  world.load(tests::short_mission(GetParam()));
  ASSERT_TRUE(world.run_until_phase(phase::flying, 60)) << world.story();
  const auto flying = state_token(world.durable());
  world.run_for(3);
  EXPECT_EQ(state_token(world.durable()), flying);
  ASSERT_TRUE(world.say(command_kind::pause).is_taken);
  ASSERT_TRUE(world.run_until_phase(phase::paused, 20)) << world.story();
  EXPECT_NE(state_token(world.durable()), flying);
}

TEST_P(state_token_of,
       a_command_that_was_meant_for_another_state_is_refused_with_the_state_as_it_is_and_a_stop_is_not) {
  flight_world world({.who = GetParam()});
  world.load(tests::short_mission(GetParam()));
  ASSERT_TRUE(world.run_until_phase(phase::flying, 60)) << world.story();
  ASSERT_TRUE(world.run_until([&] { return world.vehicle().describe().ground_speed_mps > 1; }, 60)) << "off the ground";
  const auto before = state_token(world.durable());
  EXPECT_TRUE(world.say(meant_for(command_kind::pause, "another one")).is_taken);
  ASSERT_TRUE(world.run_until_phase(phase::paused, 20)) << world.story();
  const auto refused = world.say(meant_for(command_kind::resume, before));
  EXPECT_FALSE(refused.is_taken);
  EXPECT_EQ(refused.state, state_token(world.durable()));
  const auto taken = world.say(meant_for(command_kind::resume, refused.state));
  EXPECT_TRUE(taken.is_taken) << taken.reason;
}

INSTANTIATE_TEST_SUITE_P(every_vehicle, state_token_of,
                         testing::Values(personality::rover, personality::px4, personality::ardupilot),
                         [](const auto& each) { return std::string(io::name_of(each.param)); });

} // namespace state_token_test
} // namespace godwit::executor
