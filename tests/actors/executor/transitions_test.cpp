// Flights through rows of the phase table that no other test takes.
#include <algorithm>

#include <gtest/gtest.h>

#include "tests/actors/executor/flight_world.hpp"
#include "tests/support/vehicle_modes.hpp"

namespace godwit::executor {
namespace transitions_test {

using operators::command_kind;
using sim::personality;
using tests::flight_world;
using tests::landing_mode;
using tests::mission_mode;
using tests::pilot_mode;

constexpr std::uint16_t set_mode = 176;
constexpr std::uint16_t mission_start = 300;
constexpr std::uint16_t arm_disarm = 400;
constexpr std::uint8_t denied = 2;

class transitions : public testing::TestWithParam<personality> {
protected:
  [[nodiscard]] static testing::AssertionResult fly(flight_world& world, const mission::document& mission) {
    world.load(mission);
    if (!world.run_until_phase(phase::flying))
      return testing::AssertionFailure() << world.story();
    world.run_for(3);
    return testing::AssertionSuccess();
  }

  [[nodiscard]] static testing::AssertionResult fly_when_started(flight_world& world) {
    world.load(tests::short_mission(GetParam()));
    if (!world.run_until_phase(phase::ready) || !world.say(command_kind::start).is_taken ||
        !world.run_until_phase(phase::flying))
      return testing::AssertionFailure() << world.story();
    world.run_for(3);
    return testing::AssertionSuccess();
  }

  [[nodiscard]] static testing::AssertionResult pilot_takes_over(flight_world& world) {
    world.switch_mode(pilot_mode(GetParam()));
    if (!world.run_until([&] { return needs_hand_back(world.durable().status.cause); }, 10))
      return testing::AssertionFailure() << world.story();
    return testing::AssertionSuccess();
  }
};

class transitions_in_the_air : public transitions {};

TEST_P(transitions, a_start_that_is_stopped_before_it_moved_is_prepared_again_by_a_resume) {
  flight_world world({.who = GetParam(), .start = start_policy::on_command});
  world.load(tests::short_mission(GetParam()));
  ASSERT_TRUE(world.run_until_phase(phase::ready)) << world.story();
  world.lose_command(arm_disarm, 5);
  ASSERT_TRUE(world.say(command_kind::start).is_taken);
  ASSERT_TRUE(world.run_until_phase(phase::starting)) << world.story();
  ASSERT_TRUE(world.say(command_kind::pause).is_taken) << world.story();
  world.run_for(2);
  EXPECT_EQ(world.durable().status.now, phase::paused) << world.story();
  EXPECT_EQ(world.durable().status.cause, pause_cause::asked);
  EXPECT_FALSE(world.durable().status.in_flight);
  world.run_for(10);
  ASSERT_TRUE(world.say(command_kind::resume).is_taken) << world.story();
  EXPECT_TRUE(world.run_until_phase(phase::ready)) << world.story();
}

// Its MISSION_START would fly that.
TEST(transition, a_start_ends_when_the_vehicle_has_another_plan) {
  flight_world world({.who = personality::px4, .start = start_policy::on_command});
  world.load(tests::short_mission(personality::px4));
  ASSERT_TRUE(world.run_until_phase(phase::ready)) << world.story();
  world.run_for(10);
  world.lose_command(arm_disarm, 1);
  ASSERT_TRUE(world.say(command_kind::start).is_taken);
  ASSERT_TRUE(world.run_until_phase(phase::starting)) << world.story();
  world.vehicle_tells(io::mavlink::mission_current{.seq = 0, .total = 9, .mission_state = 2, .mission_id = 4711});
  world.run_for(0.2);
  EXPECT_EQ(world.durable().status.cause, pause_cause::foreign_plan) << world.story();
  world.run_for(20);
  EXPECT_EQ(std::ranges::count(world.commands(), mission_start), 0) << world.story();
  EXPECT_FALSE(world.vehicle().describe().armed) << world.story();
}

TEST_P(transitions, what_is_brought_while_it_is_held_is_not_begun) {
  flight_world world({.who = GetParam()});
  ASSERT_TRUE(fly(world, tests::short_mission(GetParam())));
  ASSERT_TRUE(world.say(command_kind::pause).is_taken);
  ASSERT_TRUE(world.run_until_phase(phase::paused, 10)) << world.story();
  mission::assignment assignment;
  assignment.assignment_id = "11111111-2222-4333-8444-100000000001";
  assignment.base_revision = 1;
  assignment.revision = 2;
  assignment.replace_after_item_id = "w1";
  assignment.items = {tests::place("z", -20, 20, GetParam() == personality::rover ? 0 : 20)};
  world.assign(assignment);
  ASSERT_TRUE(world.run_until([&] { return !world.answers().empty(); }, 60)) << world.story();
  world.run_for(10);
  EXPECT_EQ(world.durable().status.now, phase::paused) << world.story();
  EXPECT_EQ(world.durable().status.cause, pause_cause::asked);
  EXPECT_EQ(world.durable().mission->revision, 2);
}

TEST_P(transitions_in_the_air, a_resume_that_is_refused_ends_in_a_pause_with_the_reason) {
  flight_world world({.who = GetParam()});
  ASSERT_TRUE(fly(world, tests::short_mission(GetParam())));
  ASSERT_TRUE(world.say(command_kind::pause).is_taken);
  ASSERT_TRUE(world.run_until_phase(phase::paused, 10)) << world.story();
  world.run_for(6);
  world.vehicle().refuse_command(set_mode, denied, -1);
  ASSERT_TRUE(world.say(command_kind::resume).is_taken);
  world.run_for(20);
  EXPECT_EQ(world.durable().status.now, phase::paused) << world.story();
  EXPECT_EQ(world.durable().status.cause, pause_cause::not_done) << world.story();
}

TEST_P(transitions_in_the_air, a_landing_of_the_autopilot_without_gps_is_not_called_a_pilots) {
  flight_world world({.who = GetParam()});
  ASSERT_TRUE(fly(world, tests::short_mission(GetParam())));
  world.vehicle().lose_position(true, world.now_ns());
  ASSERT_TRUE(world.run_until([&] { return needs_hand_back(world.durable().status.cause); }, 20)) << world.story();
  EXPECT_EQ(world.durable().status.cause, pause_cause::autopilot_failsafe) << world.story();
}

TEST_P(transitions, handed_back_in_its_mission_mode_it_flies_on) {
  flight_world world({.who = GetParam()});
  ASSERT_TRUE(fly(world, tests::short_mission(GetParam())));
  ASSERT_TRUE(pilot_takes_over(world));
  world.switch_mode(mission_mode(GetParam()));
  ASSERT_TRUE(world.run_until([&] { return world.heard_mode() == mission_mode(GetParam()); }, 5)) << world.story();
  EXPECT_EQ(world.durable().status.cause, pause_cause::taken_over) << world.story();
  world.run_for(0.1); // the acknowledgement of the pilot's mode is on its way
  ASSERT_TRUE(world.say(command_kind::hand_back).is_taken);
  world.run_for(0.5);
  EXPECT_EQ(world.durable().status.now, phase::flying) << world.story();
  EXPECT_TRUE(world.run_until_phase(phase::done)) << world.story();
}

TEST_P(transitions_in_the_air, handed_back_after_a_plan_that_ends_in_the_air_it_waits_as_before) {
  auto mission = tests::short_mission(GetParam());
  mission.items.pop_back();
  flight_world world({.who = GetParam()});
  ASSERT_TRUE(fly(world, mission));
  ASSERT_TRUE(world.run_until([&] { return world.durable().status.cause == pause_cause::plan_ended; }, 600))
      << world.story();
  ASSERT_TRUE(pilot_takes_over(world));
  world.run_for(3);
  ASSERT_TRUE(world.say(command_kind::hand_back).is_taken);
  world.run_for(1);
  EXPECT_EQ(world.durable().status.cause, pause_cause::plan_ended) << world.story();
}

TEST_P(transitions_in_the_air, after_the_end_a_hand_back_lets_the_next_mission_be_prepared) {
  flight_world world({.who = GetParam(), .start = start_policy::on_command});
  auto mission = tests::short_mission(GetParam());
  mission.items.pop_back();
  world.load(mission);
  ASSERT_TRUE(world.run_until_phase(phase::ready)) << world.story();
  ASSERT_TRUE(world.say(command_kind::start).is_taken);
  ASSERT_TRUE(world.run_until([&] { return world.durable().status.cause == pause_cause::plan_ended; }, 600))
      << world.story();
  ASSERT_TRUE(pilot_takes_over(world));
  world.switch_mode(landing_mode(GetParam()));
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  EXPECT_EQ(world.durable().status.cause, pause_cause::taken_over) << world.story();
  auto next = tests::short_mission(GetParam());
  next.mission_id = "99999999-6b0c-4c55-9d0d-2f6d3c8b1a42";
  world.load(next);
  world.run_for(20);
  EXPECT_EQ(world.durable().status.now, phase::done) << world.story();
  ASSERT_TRUE(world.say(command_kind::hand_back).is_taken);
  EXPECT_TRUE(world.run_until_phase(phase::ready)) << world.story();
}

mission::assignment another_place(personality who) {
  mission::assignment result;
  result.assignment_id = "11111111-2222-4333-8444-100000000001";
  result.base_revision = 1;
  result.revision = 2;
  result.replace_after_item_id = "w2";
  result.items = {tests::place("z", -20, 20, who == personality::rover ? 0 : 20)};
  return result;
}

// The failsafe is told the limits of the plan again, and the mission mode follows: of a flight that goes on.
TEST_P(transitions_in_the_air, what_a_restart_has_left_to_be_done_is_void_after_the_flight) {
  flight_world world({.who = GetParam(), .start = start_policy::on_command});
  ASSERT_TRUE(fly_when_started(world));
  world.assign(another_place(GetParam()));
  ASSERT_TRUE(world.run_until([&] { return world.durable().progress.upload.has_value(); }, 20)) << world.story();
  world.crash();
  ASSERT_TRUE(pilot_takes_over(world));
  world.switch_mode(landing_mode(GetParam()));
  ASSERT_TRUE(world.run_until([&] { return !world.durable().status.in_flight; }, 60)) << world.story();
  world.run_for(5);
  ASSERT_TRUE(world.say(command_kind::hand_back).is_taken) << world.story();
  world.run_for(1);
  ASSERT_TRUE(world.say(command_kind::resume).is_taken) << world.story();
  EXPECT_FALSE(world.run_until([&] { return world.durable().status.in_flight; }, 20)) << world.story();
}

// A battery is changed, or the vehicle is switched off: nothing that is needed is lost.
TEST_P(transitions, an_autopilot_that_starts_again_after_the_mission_leaves_it_ended) {
  flight_world world({.who = GetParam(), .start = start_policy::on_command});
  ASSERT_TRUE(fly_when_started(world));
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  world.run_for(10);
  world.vehicle().reboot(world.now_ns());
  world.run_for(20);
  EXPECT_EQ(world.durable().status.now, phase::done) << world.story();
  auto next = tests::short_mission(GetParam());
  next.mission_id = "22222222-3333-4444-8555-666666666666";
  world.load(next);
  EXPECT_TRUE(world.run_until_phase(phase::ready, 60)) << world.story();
}

INSTANTIATE_TEST_SUITE_P(each, transitions,
                         testing::Values(personality::px4, personality::ardupilot, personality::rover));
INSTANTIATE_TEST_SUITE_P(each, transitions_in_the_air, testing::Values(personality::px4, personality::ardupilot));

} // namespace transitions_test
} // namespace godwit::executor
