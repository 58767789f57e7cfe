// How flights begin and end on vehicles that say less than one would like.
#include <algorithm>

#include <gtest/gtest.h>

#include "tests/actors/executor/flight_checks.hpp"
#include "tests/actors/executor/flight_world.hpp"

namespace godwit::executor {
namespace flight_end_test {

using mission::progress_kind;
using tests::flight_world;
using tests::is_told;

class flight_end : public testing::TestWithParam<sim::personality> {};
class landing_end : public flight_end {};      // of what flies
class end_after_return : public flight_end {}; // of what does not circle there for ever

// Take-off, one waypoint, landing there.
mission::document with_landing() {
  auto result = tests::short_mission(sim::personality::px4);
  result.items.resize(2);
  result.items.emplace_back(mission::land{"down", std::get<mission::waypoint>(result.items[1]).at});
  return result;
}

// -- the end ------------------------------------------------------------------------------------------

TEST_P(landing_end, a_landing_ends_the_mission_also_where_the_vehicle_does_not_say_that_it_is_done) {
  flight_world world({.who = GetParam()});
  world.load(with_landing());
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  EXPECT_TRUE(is_told(world, progress_kind::reached, "down")) << world.story();
  EXPECT_EQ(world.reports().back().kind, progress_kind::complete) << world.story();
}

TEST(flight_end_of_px4, who_holds_when_it_has_landed_by_its_plan_has_reached_its_landing_and_completed_the_mission) {
  for (const double speed : {1.0, 5.0}) {
    flight_world world({.who = sim::personality::px4, .speed = speed, .holds_when_landed = true});
    world.load(with_landing());
    ASSERT_TRUE(world.run_until(
        [&] { return world.durable().status.now == phase::done || world.durable().status.cause != pause_cause::none; },
        600))
        << world.story();
    EXPECT_EQ(world.durable().status.now, phase::done) << world.story();
    EXPECT_TRUE(is_told(world, progress_kind::reached, "down")) << world.story();
    EXPECT_EQ(world.reports().back().kind, progress_kind::complete) << world.story();
    EXPECT_EQ(world.durable().status.cause, pause_cause::none) << world.story();
  }
}

// PX4 leaves its mission mode for the return.
TEST_P(landing_end, killed_while_the_plan_brings_it_home_it_sees_nobodys_takeover) {
  flight_world world({.who = GetParam()});
  world.load(tests::short_mission(GetParam()));
  ASSERT_TRUE(world.run_until([&] { return is_told(world, progress_kind::reached, "w3"); }, 600)) << world.story();
  world.run_for(3);
  const auto commands = world.commands().size();
  world.crash_all();
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  EXPECT_EQ(world.commands().size(), commands) << world.story();
  EXPECT_TRUE(is_told(world, progress_kind::reached, "home")) << world.story();
}

TEST_P(landing_end, on_the_way_home_that_the_plan_leads_the_failsafe_still_acts) {
  flight_world world({.who = GetParam(), .speed = 1});
  world.load(tests::short_mission(GetParam()));
  ASSERT_TRUE(world.run_until([&] { return is_told(world, progress_kind::reached, "w3"); }, 600)) << world.story();
  world.run_for(3);
  world.vehicle().set_battery(3, world.now_ns());
  EXPECT_TRUE(world.run_until([&] { return !world.reactions().empty(); }, 15)) << world.story();
}

TEST_P(end_after_return, killed_after_it_was_called_home_it_sees_nobodys_takeover) {
  flight_world world({.who = GetParam()});
  world.load(tests::short_mission(GetParam()));
  ASSERT_TRUE(world.run_until([&] { return is_told(world, progress_kind::reached, "w1"); }, 600)) << world.story();
  ASSERT_TRUE(world.say(operators::command_kind::come_home).is_taken);
  ASSERT_TRUE(world.run_until_phase(phase::landing, 20)) << world.story();
  const auto commands = world.commands().size();
  world.crash_all();
  world.run_for(2);
  EXPECT_NE(world.durable().status.now, phase::paused) << world.story();
  ASSERT_TRUE(world.run_until_phase(phase::aborted)) << world.story();
  EXPECT_EQ(world.commands().size(), commands) << world.story();
}

// -- the next flight ------------------------------------------------------------------------------------

// PX4 stays in its mission mode, and would begin what comes next as soon as somebody arms it.
TEST_P(landing_end, on_the_ground_it_is_taken_out_of_its_mission_before_the_next_plan_comes) {
  flight_world world({.who = GetParam(), .start = start_policy::on_command, .has_service = false});
  world.load(with_landing());
  ASSERT_TRUE(world.run_until_phase(phase::ready)) << world.story();
  ASSERT_TRUE(world.say(operators::command_kind::start).is_taken);
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  auto next = tests::short_mission(GetParam());
  next.mission_id = "99999999-6b0c-4c55-9d0d-2f6d3c8b1a42";
  world.load(next);
  ASSERT_TRUE(world.run_until_phase(phase::ready)) << world.story();
  if (GetParam() == sim::personality::px4) {
    EXPECT_EQ(world.vehicle().describe().mode, "AUTO.LOITER");
  }
  ASSERT_TRUE(world.say(operators::command_kind::start).is_taken);
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
}

// -- the start ------------------------------------------------------------------------------------------

constexpr std::uint16_t arming = 400;
// A PX4 is started by its mission mode.
std::uint16_t start_of(sim::personality who) { return who == sim::personality::px4 ? 176 : 300; }
constexpr std::uint8_t failed = 4;

TEST_P(flight_end, an_automatic_start_that_is_refused_for_now_is_tried_on) {
  flight_world world({.who = GetParam(), .speed = 1});
  world.vehicle().refuse_command(arming, failed, 8);
  world.load(tests::short_mission(GetParam()));
  ASSERT_TRUE(world.run_until_phase(phase::flying, 60)) << world.story();
  EXPECT_GT(std::ranges::count(world.commands(), arming), 8);
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
}

TEST_P(flight_end,
       an_automatic_start_that_is_refused_is_told_in_one_sentence_while_it_is_tried_and_when_it_is_not_any_more) {
  flight_world world({.who = GetParam(), .speed = 1});
  world.vehicle().refuse_command(arming, failed, -1);
  world.load(tests::short_mission(GetParam()));
  const auto says = [&](std::string_view what) { return world.sentence().find(what) != std::string::npos; };
  ASSERT_TRUE(world.run_until([&] { return says("tries it again"); }, 60)) << world.story();
  EXPECT_TRUE(world.run_until([&] { return world.durable().status.cause == pause_cause::not_done; }, 90))
      << world.story();
  EXPECT_TRUE(says("was asked to arm")) << world.sentence();
  EXPECT_FALSE(says("tries it again")) << world.sentence();
  for (const auto& each : world.said())
    EXPECT_EQ(each.find("a person has to start it"), std::string::npos) << each;
}

// It may stand armed, with a person beside it who thinks that nothing comes of it any more.
TEST_P(flight_end, after_an_arm_that_was_not_refused_only_a_person_starts_again) {
  flight_world world({.who = GetParam(), .speed = 1});
  world.vehicle().refuse_command(start_of(GetParam()), failed, 8);
  world.load(tests::short_mission(GetParam()));
  ASSERT_TRUE(world.run_until_phase(phase::paused, 60)) << world.story();
  EXPECT_EQ(world.durable().status.cause, pause_cause::not_done) << world.story();
  const auto armings = world.arms();
  world.run_for(90);
  EXPECT_EQ(world.durable().status.now, phase::paused) << world.story();
  EXPECT_EQ(world.arms(), armings) << "it is disarmed, and not armed again";
  EXPECT_EQ(world.disarms(), 1) << world.story();
}

TEST_P(flight_end, what_was_armed_for_a_start_that_failed_is_disarmed_again) {
  flight_world world({.who = GetParam(), .speed = 1}); // faster, PX4 would disarm by itself
  world.vehicle().refuse_command(start_of(GetParam()), failed, -1);
  world.load(tests::short_mission(GetParam()));
  ASSERT_TRUE(world.run_until_phase(phase::paused, 120)) << world.story();
  EXPECT_EQ(world.durable().status.cause, pause_cause::not_done);
  EXPECT_TRUE(world.run_until([&] { return !world.vehicle().describe().armed; }, 4)) << world.story();
  world.run_for(2);
  EXPECT_FALSE(world.durable().doing) << world.story();
}

// -- the mission before ---------------------------------------------------------------------------------

// Whoever begins anew asks the service for the mission in its settings, and is told it, whatever was flown since.
TEST_P(flight_end, a_done_mission_is_not_prepared_again_when_the_service_tells_it_after_another_one) {
  flight_world world({.who = GetParam(), .start = start_policy::on_command});
  const auto first = tests::short_mission(GetParam());
  auto second = first;
  second.mission_id = "0b9f6a3c-2d41-4e7a-9c55-6f1e8d2a7b30";
  for (const auto& each : {first, second}) {
    world.load(each);
    ASSERT_TRUE(world.run_until_phase(phase::ready, 120)) << world.story();
    ASSERT_TRUE(world.say(operators::command_kind::start).is_taken) << world.story();
    ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  }
  const auto orders = world.orders();
  world.crash_all();
  world.load(first);
  world.run_for(60);
  EXPECT_EQ(world.durable().status.now, phase::done) << world.story();
  EXPECT_EQ(world.durable().mission->mission_id, second.mission_id) << world.story();
  EXPECT_EQ(world.orders(), orders) << world.story();
}

TEST_P(flight_end, a_newer_revision_of_a_mission_that_was_done_is_prepared_after_another_one) {
  flight_world world({.who = GetParam()});
  const auto first = tests::short_mission(GetParam());
  auto second = first;
  second.mission_id = "0b9f6a3c-2d41-4e7a-9c55-6f1e8d2a7b30";
  for (const auto& each : {first, second}) {
    world.load(each);
    world.run_for(1);
    ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  }
  auto newer = first;
  newer.revision = 2;
  world.load(newer);
  world.run_for(1);
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  EXPECT_EQ(world.reports().back().mission_id, first.mission_id) << world.story();
  EXPECT_EQ(world.reports().back().revision, 2) << world.story();
}

// -- before it can be armed -----------------------------------------------------------------------------

TEST_P(landing_end, ready_is_not_said_before_the_vehicle_can_be_armed) {
  flight_world world({.who = GetParam(), .start = start_policy::on_command, .speed = 1});
  world.load(with_landing());
  ASSERT_TRUE(world.run_until_phase(phase::ready, 120)) << world.story();
  world.arm_by_hand();
  world.run_for(0.5);
  EXPECT_TRUE(world.vehicle().describe().armed) << world.story();
}

// -- a change that waits --------------------------------------------------------------------------------

// The vehicle tells its home less often than its place.
TEST_P(flight_end, a_change_that_waits_over_a_kill_waits_for_the_vehicles_home_too) {
  flight_world world({.who = GetParam()});
  world.load(tests::short_mission(GetParam()));
  ASSERT_TRUE(world.run_until([&] { return is_told(world, progress_kind::started, "w2"); }, 600)) << world.story();
  auto longer = tests::short_mission(GetParam());
  longer.revision = 2;
  const auto w4 = tests::place(GetParam(), "w4", 20, 60);
  if (GetParam() == sim::personality::plane)
    longer.items.insert(longer.items.end() - 1, w4);
  else
    longer.items.back() = w4;
  world.cut_line(8);
  world.run_for(5);
  world.load(longer);
  ASSERT_TRUE(world.run_until([&] { return world.durable().arrived.has_value(); }, 1)) << world.story();
  world.crash_all();
  ASSERT_TRUE(world.run_until([&] { return world.durable().mission->revision == 2; }, 60)) << world.story();
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
}

INSTANTIATE_TEST_SUITE_P(each, landing_end, testing::Values(sim::personality::px4, sim::personality::ardupilot));
INSTANTIATE_TEST_SUITE_P(each, end_after_return,
                         testing::Values(sim::personality::px4, sim::personality::ardupilot, sim::personality::rover));
INSTANTIATE_TEST_SUITE_P(each, flight_end,
                         testing::Values(sim::personality::px4, sim::personality::ardupilot, sim::personality::rover,
                                         sim::personality::plane));

} // namespace flight_end_test
} // namespace godwit::executor
