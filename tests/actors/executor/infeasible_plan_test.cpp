// A PX4 takes any plan, and finds out after that whether it can be flown. What godwit makes of one that it can not.
#include <algorithm>

#include <gtest/gtest.h>

#include "tests/actors/executor/flight_checks.hpp"
#include "tests/actors/executor/flight_world.hpp"

namespace godwit::executor {
namespace infeasible_plan_test {

using mission::progress_kind;
using operators::command_kind;
using tests::flight_world;
using tests::fly_to;

constexpr auto px4 = sim::personality::px4;
constexpr double limit_m = 150;

operators::command go_to(double north_m, double east_m) {
  operators::command result;
  result.kind = command_kind::go_to;
  result.place = std::get<mission::waypoint>(tests::place("", north_m, east_m, 20)).at;
  return result;
}

bool is_complete(const flight_world& world) {
  return std::ranges::any_of(world.reports(), [](const auto& each) { return each.kind == progress_kind::complete; });
}

bool says(const flight_world& world, std::string_view what) {
  return std::ranges::any_of(world.said(), [&](const auto& each) { return each.find(what) != std::string::npos; });
}

bool is_held_again(const flight_world& world) {
  const auto& at = world.durable().status;
  return at.now == phase::paused && at.cause == pause_cause::asked && !world.durable().doing;
}

// On the way to w2, sent to where the vehicle's own limit does not let it.
testing::AssertionResult send_too_far(flight_world& world) {
  if (auto came = fly_to(world, tests::short_mission(px4), progress_kind::started, "w2"); !came)
    return came;
  world.run_for(2);
  world.vehicle().limit_distance(limit_m);
  if (const auto answer = world.say(go_to(2 * limit_m, 0)); !answer.is_taken)
    return testing::AssertionFailure() << answer.reason;
  if (!world.run_until([&] { return says(world, "can not be flown"); }, 30))
    return testing::AssertionFailure() << world.sentence() << "\n" << world.story();
  return testing::AssertionSuccess();
}

class infeasible_goto : public testing::TestWithParam<bool> {}; // with a service

TEST_P(infeasible_goto, is_told_as_what_it_is_and_the_plan_before_is_brought_back_and_flown_by_a_resume) {
  flight_world world({.who = px4, .has_service = GetParam()});
  ASSERT_TRUE(send_too_far(world));
  EXPECT_FALSE(says(world, "not godwit's")) << world.story();
  ASSERT_TRUE(world.run_until([&] { return is_held_again(world); }, 20)) << world.sentence() << world.story();
  EXPECT_NE(world.sentence().find("resume goes on"), std::string::npos) << world.sentence();
  EXPECT_EQ(world.vehicle().describe().mode, "AUTO.LOITER");
  world.run_for(5);
  ASSERT_TRUE(world.say(command_kind::resume).is_taken) << world.sentence();
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.sentence() << world.story();
  EXPECT_TRUE(is_complete(world)) << world.story();
  EXPECT_EQ(world.arms(), 1);
}

TEST_P(infeasible_goto, leaves_another_goto_a_cancel_and_a_return_possible) {
  for (const bool comes_home : {false, true}) {
    flight_world world({.who = px4, .has_service = GetParam()});
    ASSERT_TRUE(send_too_far(world));
    ASSERT_TRUE(world.run_until([&] { return is_held_again(world); }, 20)) << world.sentence() << world.story();
    if (comes_home) {
      ASSERT_TRUE(world.say(command_kind::come_home).is_taken) << world.sentence();
      ASSERT_TRUE(world.run_until_phase(phase::aborted)) << world.sentence() << world.story();
      continue;
    }
    const auto again = world.say(go_to(limit_m / 2, 0));
    ASSERT_TRUE(again.is_taken) << again.reason;
    ASSERT_TRUE(world.run_until([&] { return world.durable().status.now == phase::flying; }, 20))
        << world.sentence() << world.story();
    world.run_for(20);
    const auto cancelled = world.say(command_kind::cancel);
    ASSERT_TRUE(cancelled.is_taken) << cancelled.reason;
    ASSERT_TRUE(world.run_until_phase(phase::done)) << world.sentence() << world.story();
    EXPECT_TRUE(is_complete(world)) << world.story();
  }
}

TEST_P(infeasible_goto, is_given_up_by_a_crash_at_any_moment_without_a_word_of_somebody_elses_plan) {
  for (int step = 0; step < 12; ++step) {
    flight_world world({.who = px4, .speed = 1, .has_service = GetParam()});
    ASSERT_TRUE(fly_to(world, tests::short_mission(px4), progress_kind::started, "w2"));
    world.run_for(2);
    world.vehicle().limit_distance(limit_m);
    ASSERT_TRUE(world.say(go_to(2 * limit_m, 0)).is_taken);
    world.run_for(0.25 * step);
    world.crash();
    world.run_for(20);
    EXPECT_FALSE(says(world, "not godwit's")) << step << "\n" << world.story();
    EXPECT_FALSE(says(world, "a pilot has the vehicle")) << step << "\n" << world.story();
    ASSERT_TRUE(world.say(command_kind::come_home).is_taken) << step << world.sentence();
    EXPECT_TRUE(world.run_until_phase(phase::aborted)) << step << world.sentence() << world.story();
  }
}

INSTANTIATE_TEST_SUITE_P(each, infeasible_goto, testing::Bool());

TEST(infeasible_plan, on_the_ground_is_never_ready_and_not_armed_and_another_look_is_had_by_a_resume) {
  flight_world world({.who = px4, .speed = 1});
  world.vehicle().limit_distance(30);
  world.load(tests::short_mission(px4));
  ASSERT_TRUE(world.run_until_phase(phase::paused, 60)) << world.story();
  EXPECT_EQ(world.durable().status.cause, pause_cause::infeasible_plan) << world.story();
  EXPECT_NE(world.sentence().find("can not be flown"), std::string::npos) << world.sentence();
  world.run_for(30);
  EXPECT_EQ(world.arms(), 0) << world.story();
  EXPECT_FALSE(says(world, "ready")) << world.story();
  ASSERT_TRUE(world.say(command_kind::resume).is_taken); // and nothing is changed
  world.run_for(20);
  EXPECT_EQ(world.durable().status.cause, pause_cause::infeasible_plan) << world.story();
  world.vehicle().limit_distance(0);
  ASSERT_TRUE(world.say(command_kind::resume).is_taken);
  ASSERT_TRUE(world.run_until_phase(phase::ready, 60)) << world.sentence() << world.story();
  ASSERT_TRUE(world.say(command_kind::start).is_taken) << world.sentence();
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
}

// A PX4 that has just started keeps its plan, and finds no mission in it before it has a position.
TEST(infeasible_plan, is_not_what_a_vehicle_holds_that_has_started_again_and_has_not_checked_it_yet) {
  flight_world world({.who = px4, .start = start_policy::on_command, .speed = 1});
  world.load(tests::short_mission(px4));
  ASSERT_TRUE(world.run_until_phase(phase::ready, 60)) << world.story();
  world.vehicle().reboot(world.now_ns());
  world.run_for(20);
  EXPECT_EQ(world.durable().status.cause, pause_cause::vehicle_restarted) << world.story();
  ASSERT_TRUE(world.say(command_kind::resume).is_taken);
  ASSERT_TRUE(world.run_until_phase(phase::ready, 60)) << world.sentence() << world.story();
}

// The vehicle flies what is brought to it, and holds by itself where it can not.
TEST(infeasible_plan, of_an_assignment_is_rejected_with_the_reason_and_the_mission_goes_on_after_a_word) {
  flight_world world({.who = px4});
  ASSERT_TRUE(fly_to(world, tests::short_mission(px4), progress_kind::started, "w2"));
  world.run_for(1);
  world.vehicle().limit_distance(limit_m);
  mission::assignment far;
  far.assignment_id = "11111111-2222-4333-8444-100000000001";
  far.base_revision = 1;
  far.revision = 2;
  far.replace_after_item_id = "w1";
  far.items = {tests::place("z", 2 * limit_m, 0, 20), tests::way_home(px4)};
  world.assign(far);
  ASSERT_TRUE(world.run_until([&] { return !world.answers().empty(); }, 20)) << world.story();
  EXPECT_EQ(world.answers().front().response.outcome, mission::assignment_outcome::rejected) << world.story();
  EXPECT_NE(world.answers().front().response.reason.value_or("").find("can not be flown"), std::string::npos);
  world.run_for(10);
  EXPECT_FALSE(says(world, "not godwit's")) << world.story();
  if (needs_hand_back(world.durable().status.cause)) {
    ASSERT_TRUE(world.say(command_kind::hand_back).is_taken);
    world.run_for(2);
  }
  ASSERT_TRUE(world.say(command_kind::resume).is_taken) << world.sentence() << world.story();
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.sentence() << world.story();
  EXPECT_TRUE(is_complete(world)) << world.story();
}

} // namespace infeasible_plan_test
} // namespace godwit::executor
