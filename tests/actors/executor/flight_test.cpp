#include <algorithm>
#include <variant>

#include <gtest/gtest.h>

#include "tests/actors/executor/flight_world.hpp"

namespace godwit::executor {
namespace {

using mission::progress_kind;
using tests::flight_world;

class every_vehicle : public testing::TestWithParam<sim::personality> {};

TEST_P(every_vehicle, flies_a_mission_from_the_fetch_to_the_delivery) {
  flight_world world({.who = GetParam()});
  const auto mission = tests::short_mission(GetParam());
  world.load(mission);
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  ASSERT_FALSE(world.reports().empty());
  EXPECT_EQ(world.reports().back().kind, progress_kind::complete) << world.story();
  EXPECT_EQ(world.pushes(), 1);
  std::vector<std::string> reached;
  for (const auto& each : world.reports())
    if (each.kind == progress_kind::reached)
      reached.push_back(*each.item_id);
  EXPECT_EQ(reached.size(), mission.items.size()) << world.story();
}

// -- a restart ------------------------------------------------------------------------------------

// Commands that would arm, take off or start.
int starts_in(const flight_world& world) {
  int result = 0;
  for (const auto each : world.commands())
    result += each == 300 || each == 400 || each == 22 ? 1 : 0;
  return result;
}

TEST_P(every_vehicle, a_crash_in_flight_disturbs_nothing_and_starts_nothing) {
  flight_world world({.who = GetParam()});
  world.load(tests::short_mission(GetParam()));
  ASSERT_TRUE(world.run_until([&] { return world.reports().size() >= 3; }, 600)) << world.story();
  const auto starts = starts_in(world);
  const auto commands = world.commands().size();
  world.crash();
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  EXPECT_EQ(starts_in(world), starts) << world.story();
  EXPECT_EQ(world.commands().size(), commands) << "nothing is sent to a vehicle that flies its mission";
  EXPECT_EQ(world.reports().back().kind, progress_kind::complete) << world.story();
}

TEST_P(every_vehicle, a_crash_on_the_ground_begins_nothing_until_an_operator_says_so) {
  flight_world world({.who = GetParam(), .start = start_policy::on_command});
  world.load(tests::short_mission(GetParam()));
  ASSERT_TRUE(world.run_until_phase(phase::ready)) << world.story();
  world.crash();
  ASSERT_TRUE(world.run_until_phase(phase::paused)) << world.story();
  EXPECT_EQ(world.durable().standing.cause, pause_cause::restarted);
  world.run_for(30);
  EXPECT_TRUE(world.commands().empty());
  EXPECT_TRUE(world.say(operator_words::verb::resume).is_taken);
  ASSERT_TRUE(world.run_until_phase(phase::ready)) << world.story();
  EXPECT_TRUE(world.say(operator_words::verb::start).is_taken);
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
}

// -- people ---------------------------------------------------------------------------------------

std::uint32_t pilot_mode(sim::personality who) { return who == sim::personality::px4 ? 0x00030000 : 0; }

TEST_P(every_vehicle, a_mode_change_that_we_did_not_command_is_a_pilot_and_nothing_is_sent) {
  flight_world world({.who = GetParam()});
  world.load(tests::short_mission(GetParam()));
  ASSERT_TRUE(world.run_until([&] { return world.reports().size() >= 3; }, 600)) << world.story();
  const auto commands = world.commands().size();
  world.switch_mode(pilot_mode(GetParam()));
  ASSERT_TRUE(world.run_until_phase(phase::paused, 10)) << world.story();
  EXPECT_EQ(world.durable().standing.cause, pause_cause::taken_over);
  EXPECT_FALSE(world.say(operator_words::verb::resume).is_taken) << "only after it was handed back";
  EXPECT_FALSE(world.say(operator_words::verb::come_home).is_taken);
  world.run_for(20);
  EXPECT_EQ(world.commands().size(), commands);
  EXPECT_TRUE(world.say(operator_words::verb::hand_back).is_taken);
  EXPECT_TRUE(world.run_until([&] { return world.durable().standing.cause == pause_cause::asked; }, 10));
  EXPECT_EQ(world.commands().size(), commands) << "handing back sends nothing by itself";
  EXPECT_TRUE(world.say(operator_words::verb::resume).is_taken);
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  EXPECT_EQ(world.reports().back().kind, progress_kind::complete) << world.story();
}

TEST_P(every_vehicle, pause_holds_and_resume_goes_on) {
  flight_world world({.who = GetParam()});
  world.load(tests::short_mission(GetParam()));
  ASSERT_TRUE(world.run_until([&] { return world.reports().size() >= 3; }, 600)) << world.story();
  EXPECT_TRUE(world.say(operator_words::verb::pause).is_taken);
  ASSERT_TRUE(world.run_until_phase(phase::paused, 10)) << world.story();
  EXPECT_EQ(world.durable().standing.cause, pause_cause::asked);
  const auto reports = world.reports().size();
  world.run_for(20);
  EXPECT_EQ(world.reports().size(), reports);
  EXPECT_TRUE(world.say(operator_words::verb::resume).is_taken);
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  EXPECT_EQ(world.reports().back().kind, progress_kind::complete) << world.story();
}

// -- replans --------------------------------------------------------------------------------------

mission::assignment other_tail(const mission::document& of) {
  mission::assignment wish;
  wish.assignment_id = "11111111-2222-4333-8444-555555555555";
  wish.base_revision = of.revision;
  wish.revision = of.revision + 1;
  wish.replace_after_item_id = "w2";
  const bool drives = std::holds_alternative<mission::waypoint>(of.items.front());
  wish.items = {tests::place("n1", 0, 0, drives ? 0 : 20), tests::place("n2", -40, 0, drives ? 0 : 20)};
  if (!drives)
    wish.items.emplace_back(mission::return_home{"home"});
  return wish;
}

TEST_P(every_vehicle, an_assignment_in_flight_replaces_the_tail_and_is_answered_with_the_last_progress) {
  flight_world world({.who = GetParam()});
  const auto mission = tests::short_mission(GetParam());
  world.load(mission);
  ASSERT_TRUE(world.run_until([&] { return world.reports().size() >= 3; }, 600)) << world.story();
  const auto before = world.reports().back();
  world.assign(other_tail(mission));
  ASSERT_TRUE(world.run_until([&] { return !world.answers().empty(); }, 60)) << world.story();
  const auto& answer = world.answers().front().response;
  EXPECT_EQ(answer.outcome, mission::assignment_outcome::accepted) << answer.reason.value_or("") << world.story();
  ASSERT_TRUE(answer.last_progress);
  EXPECT_GE(answer.last_progress->report_no, before.report_no);
  EXPECT_GT(answer.generation, before.generation);
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  EXPECT_EQ(world.answers().size(), 1U);
  std::vector<std::string> of_the_new;
  for (const auto& each : world.reports())
    if (each.revision == mission.revision + 1 && each.kind == progress_kind::reached)
      of_the_new.push_back(*each.item_id);
  EXPECT_NE(std::find(of_the_new.begin(), of_the_new.end(), "n2"), of_the_new.end()) << world.story();
  EXPECT_EQ(world.reports().back().kind, progress_kind::complete) << world.story();
  for (const auto& each : world.reports())
    EXPECT_NE(each.item_id.value_or("") == "w3" && each.kind == progress_kind::reached, true) << world.story();
}

TEST_P(every_vehicle, an_assignment_for_another_revision_is_turned_down_with_the_reason) {
  flight_world world({.who = GetParam()});
  const auto mission = tests::short_mission(GetParam());
  world.load(mission);
  ASSERT_TRUE(world.run_until([&] { return world.reports().size() >= 3; }, 600)) << world.story();
  auto wish = other_tail(mission);
  wish.base_revision = 7;
  wish.revision = 8;
  world.assign(wish);
  ASSERT_TRUE(world.run_until([&] { return !world.answers().empty(); }, 60)) << world.story();
  EXPECT_EQ(world.answers().front().response.outcome, mission::assignment_outcome::rejected);
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
}

INSTANTIATE_TEST_SUITE_P(each, every_vehicle,
                         testing::Values(sim::personality::px4, sim::personality::ardupilot, sim::personality::rover));

} // namespace
} // namespace godwit::executor
