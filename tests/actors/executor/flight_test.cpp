#include <algorithm>
#include <cmath>
#include <variant>

#include <gtest/gtest.h>

#include "actors/domain/geo/local_projection.hpp"
#include "tests/actors/executor/flight_checks.hpp"
#include "tests/actors/executor/flight_world.hpp"
#include "tests/support/vehicle_modes.hpp"

namespace godwit::executor {
namespace flight_test {

using mission::progress_kind;
using tests::flight_world;
using tests::is_told;
using tests::pilot_mode;

class every_vehicle : public testing::TestWithParam<sim::personality> {};
class who_need_not_circle : public every_vehicle {}; // and comes down, or stops, after a return

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

TEST_P(every_vehicle, another_mission_is_flown_after_the_first_and_counts_its_own_reports) {
  flight_world world({.who = GetParam()});
  world.load(tests::short_mission(GetParam()));
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  const auto first = world.reports().size();
  auto next = tests::short_mission(GetParam());
  next.mission_id = "0b9f6a3c-2d41-4e7a-9c55-6f1e8d2a7b30";
  world.load(next);
  world.run_for(1);
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  ASSERT_EQ(world.reports().size(), 2 * first) << world.story();
  EXPECT_EQ(world.reports()[first].mission_id, next.mission_id);
  EXPECT_EQ(world.reports()[first].report_no, 1U);
  EXPECT_EQ(world.reports().back().kind, progress_kind::complete);
  EXPECT_GT(world.reports().back().generation, world.reports()[first - 1].generation);
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

TEST_P(every_vehicle, a_hold_that_an_operator_asked_for_right_before_a_crash_still_comes) {
  for (const std::size_t reports : {1U, 3U, 5U}) { // also on the way to the last item
    flight_world world({.who = GetParam()});
    world.load(tests::short_mission(GetParam()));
    ASSERT_TRUE(world.run_until([&] { return world.reports().size() >= reports; }, 600)) << world.story();
    world.run_for(1);
    ASSERT_TRUE(world.say(operators::command_kind::pause).is_taken) << world.story();
    world.crash();
    ASSERT_TRUE(world.run_until_phase(phase::paused, 20)) << reports << " reports\n" << world.story();
    EXPECT_EQ(world.durable().status.cause, pause_cause::asked) << world.story();
    EXPECT_TRUE(world.say(operators::command_kind::resume).is_taken);
    ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  }
}

TEST_P(every_vehicle, a_crash_on_the_ground_begins_nothing_until_an_operator_says_so) {
  flight_world world({.who = GetParam(), .start = start_policy::on_command});
  world.load(tests::short_mission(GetParam()));
  ASSERT_TRUE(world.run_until_phase(phase::ready)) << world.story();
  world.crash();
  ASSERT_TRUE(world.run_until_phase(phase::paused)) << world.story();
  EXPECT_EQ(world.durable().status.cause, pause_cause::restarted);
  world.run_for(30);
  EXPECT_TRUE(world.commands().empty());
  EXPECT_TRUE(world.say(operators::command_kind::resume).is_taken);
  ASSERT_TRUE(world.run_until_phase(phase::ready)) << world.story();
  EXPECT_TRUE(world.say(operators::command_kind::start).is_taken);
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
}

// -- people ---------------------------------------------------------------------------------------

TEST_P(every_vehicle, a_start_that_came_through_after_a_kill_is_followed_and_not_disturbed) {
  flight_world world({.who = GetParam()});
  world.load(tests::short_mission(GetParam()));
  ASSERT_TRUE(world.run_until([&] { return starts_in(world) > 0 && world.durable().progress.start; }, 600))
      << world.story();
  world.crash_all();
  ASSERT_TRUE(world.run_until(
      [&] { return world.durable().status.now == phase::flying || world.durable().status.now == phase::paused; }, 60))
      << world.story();
  const auto starts = starts_in(world);
  const bool took_off = world.run_until_phase(phase::done, 200);
  EXPECT_EQ(starts_in(world), starts) << world.story();
  if (took_off) {
    EXPECT_EQ(world.reports().back().kind, progress_kind::complete) << world.story();
  } else {
    EXPECT_FALSE(world.vehicle().describe().in_air) << "it flies, and nobody follows" << world.story();
  }
}

TEST_P(every_vehicle, a_mode_change_that_we_did_not_command_is_a_pilot_and_nothing_is_sent) {
  flight_world world({.who = GetParam()});
  world.load(tests::short_mission(GetParam()));
  ASSERT_TRUE(world.run_until([&] { return world.reports().size() >= 3; }, 600)) << world.story();
  const auto commands = world.commands().size();
  world.switch_mode(pilot_mode(GetParam()));
  ASSERT_TRUE(world.run_until_phase(phase::paused, 10)) << world.story();
  EXPECT_EQ(world.durable().status.cause, pause_cause::taken_over);
  EXPECT_FALSE(world.say(operators::command_kind::resume).is_taken) << "only after it was handed back";
  EXPECT_FALSE(world.say(operators::command_kind::come_home).is_taken);
  world.run_for(20);
  EXPECT_EQ(world.commands().size(), commands);
  EXPECT_TRUE(world.say(operators::command_kind::hand_back).is_taken);
  EXPECT_TRUE(world.run_until([&] { return world.durable().status.cause == pause_cause::asked; }, 10));
  EXPECT_EQ(world.commands().size(), commands) << "handing back sends nothing by itself";
  EXPECT_TRUE(world.say(operators::command_kind::resume).is_taken);
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  EXPECT_EQ(world.reports().back().kind, progress_kind::complete) << world.story();
}

TEST_P(every_vehicle, pause_holds_and_resume_goes_on) {
  flight_world world({.who = GetParam()});
  world.load(tests::short_mission(GetParam()));
  ASSERT_TRUE(world.run_until([&] { return world.reports().size() >= 3; }, 600)) << world.story();
  EXPECT_TRUE(world.say(operators::command_kind::pause).is_taken);
  ASSERT_TRUE(world.run_until_phase(phase::paused, 10)) << world.story();
  EXPECT_EQ(world.durable().status.cause, pause_cause::asked);
  const auto reports = world.reports().size();
  world.run_for(20);
  EXPECT_EQ(world.reports().size(), reports);
  EXPECT_TRUE(world.say(operators::command_kind::resume).is_taken);
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  EXPECT_EQ(world.reports().back().kind, progress_kind::complete) << world.story();
}

// -- replans --------------------------------------------------------------------------------------

const mission::item& item_of(const mission::document& mission, std::string_view id) {
  return *std::ranges::find_if(mission.items, [&](const auto& each) { return mission::id_of(each) == id; });
}

mission::assignment other_tail(const mission::document& of, sim::personality who) {
  mission::assignment assignment;
  assignment.assignment_id = "11111111-2222-4333-8444-555555555555";
  assignment.base_revision = of.revision;
  assignment.revision = of.revision + 1;
  assignment.replace_after_item_id = "w2";
  assignment.items = {tests::place(who, "n1", 0, 0), tests::place(who, "n2", -40, 0)};
  if (who != sim::personality::rover)
    assignment.items.push_back(tests::way_home(who));
  return assignment;
}

TEST_P(every_vehicle, an_assignment_in_flight_replaces_the_tail_and_is_answered_with_the_last_progress) {
  flight_world world({.who = GetParam()});
  const auto mission = tests::short_mission(GetParam());
  world.load(mission);
  ASSERT_TRUE(world.run_until([&] { return world.reports().size() >= 3; }, 600)) << world.story();
  const auto before = world.reports().back();
  world.assign(other_tail(mission, GetParam()));
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

TEST_P(every_vehicle, a_survey_that_is_replanned_goes_on_with_the_line_that_was_begun) {
  flight_world world({.who = GetParam()});
  auto mission = tests::short_mission(GetParam());
  const auto corner = [](double north_m, double east_m) {
    const auto at = std::get<mission::waypoint>(tests::place(GetParam(), "", north_m, east_m)).at;
    return mission::vertex{at.latitude, at.longitude};
  };
  const double up_m = GetParam() == sim::personality::rover ? 0 : 20;
  const double spacing_m = GetParam() == sim::personality::plane ? 20 * tests::plane_goes_farther : 20;
  mission.items[mission.items.size() - 2] = mission::survey{
      "field", {corner(60, 60), corner(60, 160), corner(160, 160), corner(160, 60)}, up_m, spacing_m, 0};
  world.load(mission);
  const auto sequence_of_line = [&](std::size_t line) {
    return world.durable().flown->surveys.at(0).first_line_sequence + 2 * line + 1;
  };
  ASSERT_TRUE(world.run_until(
      [&] {
        return world.durable().status.now == phase::flying &&
               world.durable().progress.plan->generation.current == sequence_of_line(2);
      },
      900))
      << world.story();
  mission::assignment assignment{"5c3f1c84-92f1-4b7f-8a35-3e0fd1a1f3e7", 1, 2, "field", {}};
  assignment.items.push_back(tests::place(GetParam(), "after", GetParam() == sim::personality::plane ? 60 : 0, 0));
  if (GetParam() == sim::personality::plane) // it would circle for ever
    assignment.items.push_back(tests::way_home(GetParam(), "down"));
  world.assign(assignment);
  ASSERT_TRUE(world.run_until([&] { return world.durable().flown->mission.revision == 2; }, 60)) << world.story();
  ASSERT_EQ(world.durable().flown->surveys.size(), 1U);
  EXPECT_EQ(world.durable().flown->surveys[0].lines_before, 2U);
  world.crash_all();
  if (world.run_until_phase(phase::paused, 5)) { // held for the new plan: a person goes on
    ASSERT_TRUE(world.say(operators::command_kind::resume).is_taken) << world.story();
  }
  ASSERT_TRUE(world.run_until_phase(phase::done, 1'800)) << world.story();
  EXPECT_EQ(world.reports().back().kind, progress_kind::complete);
  const auto& reports = world.reports();
  EXPECT_EQ(
      std::count_if(reports.begin(), reports.end(),
                    [](const auto& each) { return each.kind == progress_kind::reached && each.item_id == "field"; }),
      1)
      << world.story();
}

TEST_P(every_vehicle, without_a_failsafe_no_new_plan_goes_to_the_vehicle_in_flight) {
  flight_world world({.who = GetParam()});
  const auto mission = tests::short_mission(GetParam());
  world.load(mission);
  ASSERT_TRUE(world.run_until([&] { return world.reports().size() >= 3; }, 600)) << world.story();
  world.lose_failsafe(true);
  world.assign(other_tail(mission, GetParam()));
  EXPECT_FALSE(world.run_until([&] { return !world.answers().empty(); }, 3)) << world.story();
  world.lose_failsafe(false);
  EXPECT_TRUE(world.run_until([&] { return !world.answers().empty(); }, 60)) << world.story();
}

TEST_P(every_vehicle, an_assignment_for_another_revision_is_turned_down_with_the_reason) {
  flight_world world({.who = GetParam()});
  const auto mission = tests::short_mission(GetParam());
  world.load(mission);
  ASSERT_TRUE(world.run_until([&] { return world.reports().size() >= 3; }, 600)) << world.story();
  auto assignment = other_tail(mission, GetParam());
  assignment.base_revision = 7;
  assignment.revision = 8;
  world.assign(assignment);
  ASSERT_TRUE(world.run_until([&] { return !world.answers().empty(); }, 60)) << world.story();
  EXPECT_EQ(world.answers().front().response.outcome, mission::assignment_outcome::rejected);
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
}

TEST_P(every_vehicle, while_another_plan_comes_the_one_before_is_known_by_its_id_where_the_vehicle_tells_one) {
  flight_world world({.who = GetParam()});
  const auto mission = tests::short_mission(GetParam());
  world.load(mission);
  ASSERT_TRUE(world.run_until([&] { return is_told(world, progress_kind::started, "w1"); }, 600)) << world.story();
  const auto before = world.durable().progress.plan->vehicle_plan_id;
  EXPECT_EQ(before.has_value(), GetParam() == sim::personality::px4 || GetParam() == sim::personality::rover);
  world.assign(other_tail(mission, GetParam()));
  ASSERT_TRUE(world.run_until([&] { return world.durable().progress.upload.has_value(); }, 60)) << world.story();
  EXPECT_EQ(world.durable().progress.upload->intent.id_before, before);
}

// What the vehicle still said of the old plan while the new one came is not taken for the new one, and an upload that
// goes on without whoever began it is not taken for one that has failed.
TEST_P(every_vehicle, a_crash_at_any_moment_of_a_replan_leaves_no_doubt_whose_plan_it_is) {
  for (int moment = 0; moment < 60; ++moment) {
    flight_world world({.who = GetParam(), .most_delay_ms = 40, .seed = 2});
    const auto mission = tests::short_mission(GetParam());
    world.load(mission);
    ASSERT_TRUE(world.run_until([&] { return is_told(world, progress_kind::started, "w1"); }, 600)) << world.story();
    auto assignment = other_tail(mission, GetParam());
    if (moment % 2 == 0)
      assignment.items.erase(assignment.items.begin()); // a plan of another length
    world.assign(assignment);
    world.run_for(0.03 * moment);
    world.crash();
    world.run_for(10);
    EXPECT_NE(world.durable().status.cause, pause_cause::foreign_plan) << moment << world.story();
    if (world.durable().status.now == phase::paused) {
      ASSERT_TRUE(world.say(operators::command_kind::resume).is_taken) << moment << world.story();
    }
    ASSERT_TRUE(world.run_until_phase(phase::done)) << moment << world.story();
    EXPECT_EQ(world.reports().back().kind, progress_kind::complete) << moment << world.story();
  }
}

// The first item of the new tail is where the vehicle is: it has passed the plan's start before that is heard of.
TEST_P(every_vehicle, a_start_that_nobody_saw_is_made_up_for_also_when_godwit_dies_in_between) {
  flight_world world({.who = GetParam()});
  const auto mission = tests::short_mission(GetParam());
  world.load(mission);
  ASSERT_TRUE(world.run_until([&] { return is_told(world, progress_kind::reached, "w2"); }, 600)) << world.story();
  auto assignment = other_tail(mission, GetParam());
  std::get<mission::waypoint>(assignment.items.front()).at = std::get<mission::waypoint>(item_of(mission, "w2")).at;
  world.assign(assignment);
  ASSERT_TRUE(world.run_until([&] { return !world.answers().empty(); }, 60)) << world.story();
  ASSERT_TRUE(world.run_until([&] { return !world.durable().doing; }, 60)) << world.story();
  world.switch_mode(pilot_mode(GetParam()));
  ASSERT_TRUE(world.run_until_phase(phase::paused, 10)) << world.story();
  world.run_for(5);
  world.crash();
  world.run_for(5);
  ASSERT_TRUE(world.say(operators::command_kind::hand_back).is_taken);
  world.run_for(1);
  ASSERT_TRUE(world.say(operators::command_kind::resume).is_taken);
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  EXPECT_EQ(world.reports().back().kind, progress_kind::complete) << world.story();
}

// -- told apart by the reports alone ----------------------------------------------------------------

// A, then B, then home; B is replaced by Z.
mission::document a_then_b(sim::personality who) {
  auto result = tests::short_mission(who);
  result.items.clear();
  if (who != sim::personality::rover)
    result.items.emplace_back(mission::takeoff{"up", 20});
  result.items.push_back(tests::place(who, "a", 60, 0));
  result.items.push_back(tests::place(who, "b", 60, 60));
  result.items.push_back(tests::place(who, "end", 0, 60));
  return result;
}

mission::assignment z_instead_of_b(const mission::document& mission, sim::personality who) {
  mission::assignment result;
  result.assignment_id = "33333333-2222-4333-8444-555555555555";
  result.base_revision = mission.revision;
  result.revision = mission.revision + 1;
  result.replace_after_item_id = "a";
  result.items = {tests::place(who, "z", 20, 20)};
  return result;
}

// What the service hears of B and Z, and nothing else of the flight: "b reached r1 g2, z reached r2 g3".
std::vector<std::string> told_of_b_and_z(const flight_world& world) {
  std::vector<std::string> result;
  for (const auto& each : world.reports())
    if (each.kind == progress_kind::reached && (each.item_id == "b" || each.item_id == "z"))
      result.push_back(*each.item_id + " of revision " + std::to_string(each.revision));
  return result;
}

TEST_P(every_vehicle, z_assigned_before_b_was_reached_is_told_apart_by_the_reports) {
  flight_world world({.who = GetParam()});
  const auto mission = a_then_b(GetParam());
  world.load(mission);
  ASSERT_TRUE(world.run_until([&] { return is_told(world, progress_kind::started, "b"); }, 600)) << world.story();
  world.assign(z_instead_of_b(mission, GetParam()));
  ASSERT_TRUE(world.run_until([&] { return world.reports().back().kind == progress_kind::complete; }, 600))
      << world.story();
  EXPECT_EQ(told_of_b_and_z(world), std::vector<std::string>{"z of revision 2"}) << world.story();
  ASSERT_EQ(world.answers().size(), 1U);
  EXPECT_EQ(world.answers().front().response.last_progress->item_id, "b") << "it had started on it" << world.story();
  EXPECT_EQ(world.answers().front().response.last_progress->kind, progress_kind::started) << world.story();
}

TEST_P(every_vehicle, z_assigned_after_b_was_reached_is_told_apart_by_the_reports) {
  flight_world world({.who = GetParam()});
  const auto mission = a_then_b(GetParam());
  world.load(mission);
  ASSERT_TRUE(world.run_until([&] { return is_told(world, progress_kind::reached, "b"); }, 600)) << world.story();
  world.assign(z_instead_of_b(mission, GetParam()));
  ASSERT_TRUE(world.run_until([&] { return is_told(world, progress_kind::reached, "z"); }, 600)) << world.story();
  EXPECT_EQ(told_of_b_and_z(world), (std::vector<std::string>{"b of revision 1", "z of revision 2"})) << world.story();
  ASSERT_EQ(world.answers().size(), 1U);
  const auto& last = *world.answers().front().response.last_progress;
  EXPECT_TRUE(last.item_id == "b" || last.item_id == "end") << world.story();
}

// A rover's mission is over where it ends; what flies waits there.
TEST_P(every_vehicle, z_assigned_after_b_the_last_item_is_flown) {
  if (GetParam() == sim::personality::rover)
    return;
  flight_world world({.who = GetParam()});
  auto mission = a_then_b(GetParam());
  mission.items.pop_back();
  world.load(mission);
  ASSERT_TRUE(world.run_until([&] { return is_told(world, progress_kind::reached, "b"); }, 600)) << world.story();
  world.run_for(1);
  auto assignment = z_instead_of_b(mission, GetParam());
  assignment.replace_after_item_id = "b";
  world.assign(assignment);
  ASSERT_TRUE(world.run_until([&] { return is_told(world, progress_kind::reached, "z"); }, 600)) << world.story();
  EXPECT_EQ(told_of_b_and_z(world), (std::vector<std::string>{"b of revision 1", "z of revision 2"})) << world.story();
  ASSERT_EQ(world.answers().size(), 1U);
  EXPECT_EQ(world.answers().front().response.outcome, mission::assignment_outcome::accepted) << world.story();
}

// -- sent elsewhere by an operator ---------------------------------------------------------------------

operators::command go_there(sim::personality who) {
  operators::command result;
  result.kind = operators::command_kind::go_to;
  result.place = std::get<mission::waypoint>(tests::place(who, "", -40, -20)).at;
  return result;
}

TEST_P(every_vehicle, sent_elsewhere_it_holds_tells_the_service_and_goes_there) {
  flight_world world({.who = GetParam()});
  world.load(tests::short_mission(GetParam()));
  ASSERT_TRUE(world.run_until([&] { return is_told(world, progress_kind::reached, "w1"); }, 600)) << world.story();
  const auto answer = world.say(go_there(GetParam()));
  ASSERT_TRUE(answer.is_taken) << answer.reason;
  ASSERT_TRUE(world.run_until([&] { return world.durable().mission->revision == 2; }, 60)) << world.story();
  ASSERT_TRUE(world.run_until_phase(phase::flying, 60)) << world.story();
  const auto& items = world.durable().mission->items;
  EXPECT_EQ(mission::id_of(items.back()).substr(0, 4), "goto") << world.story();
  world.run_for(60);
  EXPECT_FALSE(is_told(world, progress_kind::reached, "w3")) << world.story();
  EXPECT_EQ(world.durable().status.now, phase::flying) << "it stays there" << world.story();
}

// Between the second waypoint and the place stands a wall of 20 m.
TEST_P(who_need_not_circle, on_the_way_around_a_fence_corners_are_taken_narrowly_and_with_room) {
  flight_world world({.who = GetParam()});
  auto mission = tests::short_mission(GetParam());
  mission::geofence wall{mission::fence_kind::exclusion, {}, {}, {}};
  for (const auto& [north_m, east_m] : {std::pair(10, 12), std::pair(14, 12), std::pair(14, 32), std::pair(10, 32)}) {
    const auto corner = std::get<mission::waypoint>(tests::place(GetParam(), "", north_m, east_m)).at;
    wall.vertices.push_back({corner.latitude, corner.longitude});
  }
  mission.geofences = {wall};
  world.load(mission);
  ASSERT_TRUE(world.acknowledge()) << "a failsafe would return through it\n" << world.story();
  ASSERT_TRUE(world.run_until([&] { return is_told(world, progress_kind::reached, "w2"); }, 600)) << world.story();
  const auto answer = world.say(go_there(GetParam()));
  ASSERT_TRUE(answer.is_taken) << answer.reason;
  ASSERT_TRUE(world.run_until([&] { return world.durable().mission->revision == 2; }, 60)) << world.story();
  std::size_t turns = 0;
  for (const auto& each : world.durable().mission->items)
    if (const auto* turn = std::get_if<mission::waypoint>(&each); turn && turn->id.starts_with("goto")) {
      ++turns;
      EXPECT_EQ(turn->accept_radius_m, 2);
      const geo::local_projection around({turn->at.latitude, turn->at.longitude});
      for (const auto& corner : wall.vertices) {
        const auto to = around.to_local({corner.latitude, corner.longitude});
        EXPECT_GE(std::hypot(to.east_m, to.north_m), 15) << "the margin, and 5 m to turn";
      }
    }
  EXPECT_GT(turns, 0U) << world.story();
}

TEST_P(every_vehicle, cancel_goes_on_with_the_first_item_that_is_not_done) {
  flight_world world({.who = GetParam()});
  const auto mission = tests::short_mission(GetParam());
  world.load(mission);
  ASSERT_TRUE(world.run_until([&] { return is_told(world, progress_kind::reached, "w1"); }, 600)) << world.story();
  ASSERT_TRUE(world.say(go_there(GetParam())).is_taken);
  ASSERT_TRUE(world.run_until([&] { return world.durable().mission->revision == 2; }, 60)) << world.story();
  world.run_for(3);
  world.crash();
  world.run_for(3);
  const auto answer = world.say(operators::command_kind::cancel);
  ASSERT_TRUE(answer.is_taken) << answer.reason << world.story();
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  for (const auto* each : {"w2", "w3"})
    EXPECT_TRUE(is_told(world, progress_kind::reached, each)) << each << world.story();
  EXPECT_EQ(world.reports().back().kind, progress_kind::complete) << world.story();
  EXPECT_TRUE(world.durable().set_aside.empty());
}

TEST_P(every_vehicle, where_no_way_leads_is_refused_with_the_reason_and_nothing_changes) {
  flight_world world({.who = GetParam()});
  auto mission = tests::short_mission(GetParam());
  const auto to = *go_there(GetParam()).place;
  mission::geofence around;
  around.kind = mission::fence_kind::exclusion;
  for (const auto& [north, east] : {std::pair(-1, -1), std::pair(-1, 1), std::pair(1, 1), std::pair(1, -1)})
    around.vertices.push_back({to.latitude + north * 0.0001, to.longitude + east * 0.0001});
  mission.geofences = {around};
  world.load(mission);
  ASSERT_TRUE(world.run_until([&] { return is_told(world, progress_kind::reached, "w1"); }, 600)) << world.story();
  const auto answer = world.say(go_there(GetParam()));
  EXPECT_FALSE(answer.is_taken);
  EXPECT_NE(answer.reason.find("no way there"), std::string::npos) << answer.reason;
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  EXPECT_EQ(world.durable().mission->revision, 1);
}

TEST_P(every_vehicle, what_the_service_refuses_leaves_the_vehicle_held_until_it_is_resumed) {
  flight_world world({.who = GetParam()});
  world.load(tests::short_mission(GetParam()));
  world.set_changes(mission_client::change_verdict::refused);
  ASSERT_TRUE(world.run_until([&] { return is_told(world, progress_kind::reached, "w1"); }, 600)) << world.story();
  ASSERT_TRUE(world.say(go_there(GetParam())).is_taken);
  world.run_for(10);
  EXPECT_EQ(world.durable().status.now, phase::paused) << world.story();
  EXPECT_TRUE(world.durable().set_aside.empty()) << "it still has its mission";
  ASSERT_TRUE(world.say(operators::command_kind::resume).is_taken);
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  EXPECT_EQ(world.reports().back().kind, progress_kind::complete) << world.story();
}

TEST_P(every_vehicle, without_a_service_an_operator_sends_it_elsewhere_all_the_same) {
  flight_world world({.who = GetParam(), .has_service = false});
  world.load(tests::short_mission(GetParam()));
  ASSERT_TRUE(world.run_until([&] { return is_told(world, progress_kind::reached, "w1"); }, 600)) << world.story();
  ASSERT_TRUE(world.say(go_there(GetParam())).is_taken);
  ASSERT_TRUE(world.run_until([&] { return world.durable().mission->revision == 2; }, 60)) << world.story();
  world.run_for(20);
  ASSERT_TRUE(world.say(operators::command_kind::cancel).is_taken);
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  EXPECT_TRUE(is_told(world, progress_kind::reached, "w3")) << world.story();
}

TEST_P(every_vehicle, a_waypoint_is_inserted_and_the_mission_goes_on_after_it) {
  flight_world world({.who = GetParam()});
  world.load(tests::short_mission(GetParam()));
  ASSERT_TRUE(world.run_until([&] { return is_told(world, progress_kind::reached, "w1"); }, 600)) << world.story();
  auto command = go_there(GetParam());
  command.kind = operators::command_kind::insert;
  command.after = "w2";
  const auto answer = world.say(command);
  ASSERT_TRUE(answer.is_taken) << answer.reason;
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  std::vector<std::string> reached;
  for (const auto& each : world.reports())
    if (each.kind == progress_kind::reached)
      reached.push_back(each.item_id->substr(0, 5));
  const auto extra = std::find(reached.begin(), reached.end(), "extra");
  ASSERT_NE(extra, reached.end()) << world.story();
  EXPECT_EQ(*(extra - 1), "w2") << world.story();
  EXPECT_EQ(*(extra + 1), "w3") << world.story();
}

TEST_P(who_need_not_circle, inserts_that_are_refused_again_and_again_follow_the_policy) {
  for (const auto policy : {refusal_policy::go_on, refusal_policy::come_home}) {
    flight_world world({.who = GetParam(), .refused_inserts = policy});
    world.load(tests::short_mission(GetParam()));
    world.set_changes(mission_client::change_verdict::refused);
    ASSERT_TRUE(world.run_until([&] { return is_told(world, progress_kind::reached, "w1"); }, 600)) << world.story();
    auto command = go_there(GetParam());
    command.kind = operators::command_kind::insert;
    for (int i = 0; i < 3; ++i) {
      ASSERT_TRUE(world.say(command).is_taken) << world.story();
      world.run_for(0.5);
    }
    ASSERT_TRUE(world.run_until(
        [&] { return world.durable().status.now == phase::done || world.durable().status.now == phase::aborted; }, 600))
        << world.story();
    EXPECT_EQ(world.durable().status.now == phase::aborted, policy == refusal_policy::come_home) << world.story();
  }
}

// -- the failsafe -----------------------------------------------------------------------------------

TEST_P(every_vehicle, while_a_failsafe_acts_the_executor_sends_nothing) {
  flight_world world({.who = GetParam()});
  world.load(tests::short_mission(GetParam()));
  ASSERT_TRUE(world.run_until([&] { return world.reports().size() >= 3; }, 600)) << world.story();
  world.vehicle().set_battery(20, world.now_ns());
  ASSERT_TRUE(world.run_until([&] { return !world.reactions().empty(); }, 60)) << world.story();
  const auto commands = world.commands().size();
  ASSERT_TRUE(world.run_until_phase(phase::paused, 5)) << world.story();
  EXPECT_EQ(world.durable().status.cause, pause_cause::failsafe) << world.story();
  EXPECT_FALSE(world.say(operators::command_kind::resume).is_taken) << "only after a hand-back";
  world.crash();
  world.run_for(20);
  EXPECT_EQ(world.commands().size(), commands) << world.story();
  EXPECT_EQ(world.durable().status.now, phase::paused) << world.story();
}

TEST_P(every_vehicle, a_fence_of_the_mission_is_watched_from_the_start) {
  flight_world world({.who = GetParam()});
  auto mission = tests::short_mission(GetParam());
  world.load(mission);
  ASSERT_TRUE(world.run_until_phase(phase::flying, 600)) << world.story();
  EXPECT_TRUE(world.durable().flown);
  EXPECT_EQ(world.guarded(), mission.geofences) << world.story();
}

INSTANTIATE_TEST_SUITE_P(each, who_need_not_circle,
                         testing::Values(sim::personality::px4, sim::personality::ardupilot, sim::personality::rover));
INSTANTIATE_TEST_SUITE_P(each, every_vehicle,
                         testing::Values(sim::personality::px4, sim::personality::ardupilot, sim::personality::rover,
                                         sim::personality::plane));

} // namespace flight_test
} // namespace godwit::executor
