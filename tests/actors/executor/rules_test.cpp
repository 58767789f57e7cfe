// The rules that protect people, and what an operator, a station and the service may ask for and when.
#include <algorithm>
#include <array>

#include <gtest/gtest.h>

#include "io/mavlink/plan_meaning.hpp"
#include "tests/actors/executor/flight_world.hpp"
#include "tests/support/vehicle_modes.hpp"

namespace godwit::executor {
namespace rules_test {

using mission::progress_kind;
using operators::command_kind;
using tests::flight_world;

constexpr std::uint16_t arm_disarm = 400;
constexpr std::uint16_t set_mode = 176;

class rule : public testing::TestWithParam<sim::personality> {
protected:
  [[nodiscard]] static std::uint32_t pilot_mode() { return tests::pilot_mode(GetParam()); }
  [[nodiscard]] static std::uint32_t hold_mode() { return tests::hold_mode(GetParam()); }
  [[nodiscard]] static mission::document short_mission() { return tests::short_mission(GetParam()); }

  // Under way to the second waypoint.
  static testing::AssertionResult fly(flight_world& world, const mission::document& mission = short_mission()) {
    world.load(mission);
    const auto is_reached = [&] {
      return std::ranges::any_of(world.reports(), [](const auto& each) {
        return each.kind == progress_kind::reached && each.item_id == "w1";
      });
    };
    return world.run_until(is_reached, 600) ? testing::AssertionSuccess()
                                            : testing::AssertionFailure() << world.story();
  }
  static testing::AssertionResult take_over(flight_world& world) {
    world.switch_mode(pilot_mode());
    const bool is_seen = world.run_until([&] { return world.durable().status.cause == pause_cause::taken_over; }, 10);
    return is_seen ? testing::AssertionSuccess() : testing::AssertionFailure() << world.story();
  }
  static mission::assignment another_tail(int number, double north_m = 20) {
    mission::assignment result;
    result.assignment_id = "11111111-2222-4333-8444-" + std::to_string(100'000'000'000 + number);
    result.base_revision = 1;
    result.revision = 2;
    result.replace_after_item_id = "w2";
    result.items = {tests::place(GetParam(), "n" + std::to_string(number), north_m, 20)};
    return result;
  }
  // An inclusion fence around home.
  static mission::geofence square(double half_side_m) {
    mission::geofence result{mission::fence_kind::inclusion, {}, {}, {}};
    for (const auto& [north, east] : {std::pair{-1, -1}, {-1, 1}, {1, 1}, {1, -1}}) {
      const auto corner =
          std::get<mission::waypoint>(tests::place(GetParam(), "", north * half_side_m, east * half_side_m)).at;
      result.vertices.push_back({corner.latitude, corner.longitude});
    }
    return result;
  }
};

// PX4 flies on while its plan is replaced, and so can be taken over meanwhile.
class rule_of_long_replans : public rule {};

bool was_said(const flight_world& world, const std::string& words) {
  return std::ranges::any_of(world.said(), [&](const auto& each) { return each.find(words) != std::string::npos; });
}

// -- arming and starting --------------------------------------------------------------------------------

TEST_P(rule, it_arms_with_arm_on_start_only) {
  for (const auto policy : {start_policy::automatic, start_policy::on_command}) {
    flight_world world({.who = GetParam(), .start = policy, .arm_on_start = false});
    world.load(short_mission());
    ASSERT_TRUE(world.run_until_phase(phase::ready)) << world.story();
    if (policy == start_policy::on_command) {
      const auto answer = world.say(command_kind::start);
      EXPECT_FALSE(answer.is_taken);
      EXPECT_NE(answer.reason.find("starting does not arm it"), std::string::npos) << answer.reason;
    }
    world.run_for(20);
    EXPECT_TRUE(world.commands().empty()) << world.story();
    EXPECT_EQ(world.durable().status.now, phase::ready) << world.story();
  }
}

TEST_P(rule, killed_on_the_ground_in_the_middle_of_its_preparations_it_waits_for_a_person) {
  for (const auto middle : {phase::uploading, phase::starting}) {
    flight_world world({.who = GetParam()});
    world.load(short_mission());
    ASSERT_TRUE(world.run_until_phase(middle)) << world.story();
    world.crash();
    world.run_for(20);
    EXPECT_EQ(world.durable().status.now, phase::paused) << world.story();
    EXPECT_LE(std::ranges::count(world.commands(), arm_disarm), 1) << "that was on its way before\n" << world.story();
    EXPECT_FALSE(world.vehicle().describe().in_air);
  }
}

// -- the map ----------------------------------------------------------------------------------------------

TEST_P(rule, without_the_map_it_stays_on_the_ground_and_flies_when_it_is_there) {
  using mission_client::pull_state;
  for (const auto pull : {pull_state::not_started, pull_state::in_flight, pull_state::failed}) {
    flight_world world({.who = GetParam(), .map = pull});
    world.load(short_mission());
    world.run_for(20);
    EXPECT_TRUE(world.commands().empty()) << io::name_of(pull) << "\n" << world.story();
    EXPECT_FALSE(world.durable().status.in_flight) << io::name_of(pull) << "\n" << world.story();
    world.pull_map(pull_state::synced);
    EXPECT_TRUE(world.run_until_phase(phase::done)) << io::name_of(pull) << "\n" << world.story();
  }
}

TEST_P(rule, with_the_map_of_an_earlier_pull_it_flies_when_an_operator_has_acknowledged_it) {
  flight_world world({.who = GetParam(), .map = mission_client::pull_state::cached_fallback});
  world.load(short_mission());
  const auto awaits_word = [&] { return world.durable().preflight.now == preflight::phase::awaiting_ack; };
  ASSERT_TRUE(world.run_until(awaits_word, 20)) << world.story();
  world.run_for(20);
  EXPECT_TRUE(world.commands().empty()) << world.story();
  operators::command command;
  command.kind = command_kind::acknowledge;
  command.report = world.durable().preflight.report->id;
  EXPECT_TRUE(world.say(command).is_taken) << world.story();
  EXPECT_TRUE(world.run_until_phase(phase::done)) << world.story();
}

// -- a station that starts --------------------------------------------------------------------------------

start_mission start_of_shown(const flight_world& world, std::uint64_t key) {
  start_mission result;
  result.key = key;
  result.last = static_cast<std::uint16_t>(world.shown_items().size() - 1);
  result.plan_id = io::mavlink::checksum_of(world.shown_items());
  result.obey_until_ns = world.wall_ns() + 3'000'000'000;
  return result;
}

TEST_P(rule, a_start_that_comes_too_late_is_not_obeyed) {
  flight_world world({.who = GetParam(), .start = start_policy::on_command});
  world.load(short_mission());
  ASSERT_TRUE(world.run_until_phase(phase::ready)) << world.story();
  auto late = start_of_shown(world, 1);
  late.obey_until_ns = world.wall_ns() - 1;
  world.station_says(late);
  world.run_for(5);
  ASSERT_EQ(world.start_answers().size(), 1U);
  EXPECT_EQ(world.start_answers().front().verdict, start_verdict::too_late);
  EXPECT_TRUE(world.commands().empty()) << world.story();
}

TEST_P(rule, of_two_starts_the_second_is_told_that_something_is_under_way) {
  flight_world world({.who = GetParam(), .start = start_policy::on_command});
  world.load(short_mission());
  ASSERT_TRUE(world.run_until_phase(phase::ready)) << world.story();
  world.station_says(start_of_shown(world, 1));
  world.station_says(start_of_shown(world, 2));
  ASSERT_EQ(world.start_answers().size(), 1U);
  EXPECT_EQ(world.start_answers().front().key, 2U);
  EXPECT_EQ(world.start_answers().front().verdict, start_verdict::not_ready);
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  EXPECT_EQ(world.start_answers().back().key, 1U);
  EXPECT_EQ(world.start_answers().back().verdict, start_verdict::started);
}

TEST_P(rule, a_start_whose_executor_dies_is_answered_by_the_next_one) {
  flight_world world({.who = GetParam(), .start = start_policy::on_command});
  world.load(short_mission());
  ASSERT_TRUE(world.run_until_phase(phase::ready)) << world.story();
  world.station_says(start_of_shown(world, 1));
  ASSERT_TRUE(world.run_until_phase(phase::starting, 10)) << world.story();
  world.crash();
  world.run_for(5);
  ASSERT_EQ(world.start_answers().size(), 1U) << world.story();
  EXPECT_EQ(world.start_answers().front().verdict, start_verdict::failed);
}

// -- a pilot ----------------------------------------------------------------------------------------------

TEST_P(rule, while_a_pilot_flies_no_word_of_an_operator_is_taken) {
  flight_world world({.who = GetParam()});
  ASSERT_TRUE(fly(world));
  ASSERT_TRUE(take_over(world));
  operators::command there;
  there.place = std::get<mission::waypoint>(tests::place(GetParam(), "", 30, 30)).at;
  for (const auto each : {command_kind::go_to, command_kind::insert, command_kind::cancel, command_kind::pause,
                          command_kind::resume, command_kind::come_home}) {
    there.kind = each;
    const auto answer = world.say(there);
    EXPECT_FALSE(answer.is_taken) << io::name_of(each);
    EXPECT_NE(answer.reason.find("handed back first"), std::string::npos) << answer.reason;
  }
}

TEST_P(rule, while_too_much_waits_for_the_journal_no_plan_is_changed_and_a_pause_goes_out) {
  flight_world world({.who = GetParam()});
  ASSERT_TRUE(fly(world));
  world.set_journal_nearly_full(true);
  operators::command there;
  there.kind = command_kind::go_to;
  there.place = std::get<mission::waypoint>(tests::place(GetParam(), "", -40, -20)).at;
  const auto refusal = world.say(there);
  EXPECT_FALSE(refusal.is_taken);
  EXPECT_NE(refusal.reason.find("journal"), std::string::npos) << refusal.reason;
  ASSERT_TRUE(world.say(command_kind::pause).is_taken);
  EXPECT_TRUE(world.run_until_phase(phase::paused, 10)) << world.story();
  ASSERT_TRUE(world.say(command_kind::resume).is_taken);
  ASSERT_TRUE(world.run_until_phase(phase::flying, 30)) << world.story();
  world.set_journal_nearly_full(false);
  EXPECT_TRUE(world.say(there).is_taken);
}

TEST_P(rule_of_long_replans, to_come_home_does_not_wait_for_a_replan) {
  flight_world world({.who = GetParam(), .most_delay_ms = 100});
  ASSERT_TRUE(fly(world));
  world.assign(another_tail(1));
  ASSERT_TRUE(world.run_until([&] { return world.durable().doing.has_value(); }, 10)) << world.story();
  ASSERT_TRUE(world.say(command_kind::come_home).is_taken);
  EXPECT_TRUE(world.run_until_phase(phase::landing, 3)) << world.story();
  EXPECT_TRUE(world.run_until_phase(phase::aborted, 120)) << world.story();
}

// A plan that has ended leads nowhere any more when another one has taken its place.
TEST_P(rule, after_a_goto_and_back_a_hold_that_nobody_asked_for_is_a_pilots) {
  flight_world world({.who = GetParam()});
  ASSERT_TRUE(fly(world));
  operators::command there;
  there.kind = command_kind::go_to;
  there.place = std::get<mission::waypoint>(tests::place(GetParam(), "", -40, -20)).at;
  ASSERT_TRUE(world.say(there).is_taken);
  ASSERT_TRUE(world.run_until([&] { return world.durable().mission->revision == 2; }, 60)) << world.story();
  world.run_for(20);
  ASSERT_TRUE(world.say(command_kind::cancel).is_taken);
  ASSERT_TRUE(world.run_until([&] { return world.durable().mission->revision == 3; }, 60)) << world.story();
  ASSERT_TRUE(world.run_until_phase(phase::flying, 30)) << world.story();
  world.run_for(1);
  const auto commands = world.commands().size();
  world.switch_mode(hold_mode());
  world.run_for(3);
  EXPECT_EQ(world.durable().status.cause, pause_cause::taken_over) << world.story();
  world.vehicle().set_battery(20, world.now_ns());
  world.run_for(15);
  EXPECT_EQ(world.commands().size(), commands) << world.story();
  EXPECT_TRUE(world.reactions().empty()) << world.story();
}

TEST_P(rule, a_hold_after_our_own_that_nobody_asked_for_is_a_pilots) {
  flight_world world({.who = GetParam()});
  ASSERT_TRUE(fly(world));
  ASSERT_TRUE(world.say(command_kind::pause).is_taken);
  ASSERT_TRUE(world.run_until_phase(phase::paused, 10)) << world.story();
  ASSERT_TRUE(world.say(command_kind::resume).is_taken);
  ASSERT_TRUE(world.run_until_phase(phase::flying, 10)) << world.story();
  world.switch_mode(hold_mode());
  world.run_for(3);
  EXPECT_EQ(world.durable().status.cause, pause_cause::taken_over) << world.story();
}

TEST_P(rule, to_a_vehicle_that_somebody_flies_by_hand_a_mission_is_brought_and_nothing_is_commanded) {
  for (const auto policy : {start_policy::on_command, start_policy::automatic}) {
    flight_world world({.who = GetParam(), .start = policy});
    world.run_for(10);
    world.fly_by_hand(pilot_mode());
    world.load(short_mission());
    world.run_for(20);
    EXPECT_TRUE(world.commands().empty()) << world.story();
    EXPECT_TRUE(world.vehicle().describe().armed);
  }
}

TEST_P(rule, after_a_hand_back_the_failsafe_acts_again) {
  flight_world world({.who = GetParam(), .speed = 1});
  ASSERT_TRUE(fly(world));
  ASSERT_TRUE(take_over(world));
  world.run_for(2);
  ASSERT_TRUE(world.say(command_kind::hand_back).is_taken);
  world.run_for(1);
  ASSERT_TRUE(world.say(command_kind::resume).is_taken);
  ASSERT_TRUE(world.run_until_phase(phase::flying, 10)) << world.story();
  world.vehicle().set_battery(3, world.now_ns());
  EXPECT_TRUE(world.run_until([&] { return !world.reactions().empty(); }, 15)) << world.story();
}

TEST_P(rule, an_autopilot_that_starts_again_in_flight_is_left_to_people) {
  flight_world world({.who = GetParam()});
  ASSERT_TRUE(fly(world));
  world.vehicle().reboot(world.now_ns());
  ASSERT_TRUE(world.run_until_phase(phase::paused, 30)) << world.story();
  const auto commands = world.commands().size();
  world.run_for(30);
  EXPECT_EQ(world.commands().size(), commands) << world.story();
  EXPECT_TRUE(needs_hand_back(world.durable().status.cause)) << world.story();
  if (GetParam() == sim::personality::rover)
    return; // its heartbeats tell no boot: it is a person's mode
  EXPECT_TRUE(world.durable().status.reason.starts_with("the flight ended as its autopilot started again"))
      << world.story();
  EXPECT_EQ(world.story().find("pilot has the vehicle"), std::string::npos) << world.story();
}

// As a kill switch, or a crash, ends it in the mission mode.
TEST_P(rule, a_flight_that_ends_before_its_plan_is_nobodys_of_godwit_and_waits_for_a_hand_back) {
  flight_world world({.who = GetParam()});
  ASSERT_TRUE(fly(world));
  world.lose_message(io::mavlink::command_ack::message_id); // by a switch: nobody is heard to command it
  world.disarm_by_hand();
  world.run_for(2);
  world.lose_message(0);
  ASSERT_TRUE(world.run_until_phase(phase::paused, 30)) << world.story();
  const auto commands = world.commands().size();
  world.run_for(30);
  EXPECT_EQ(world.commands().size(), commands) << world.story();
  EXPECT_TRUE(needs_hand_back(world.durable().status.cause)) << world.story();
  EXPECT_TRUE(world.durable().status.reason.starts_with("the flight ended ")) << world.story();
}

// -- changes ------------------------------------------------------------------------------------------------

TEST_P(rule, so_many_assignments_wait_and_the_next_is_turned_down) {
  flight_world world({.who = GetParam()});
  ASSERT_TRUE(fly(world));
  ASSERT_TRUE(take_over(world));
  for (std::size_t i = 0; i <= max_waiting; ++i)
    world.assign(another_tail(static_cast<int>(i)));
  world.run_for(1);
  ASSERT_EQ(world.answers().size(), 1U);
  EXPECT_EQ(world.answers().front().response.outcome, mission::assignment_outcome::rejected);
  EXPECT_EQ(world.durable().waiting.size(), max_waiting);
}

TEST_P(rule, an_assignment_that_comes_when_the_mission_is_over_is_turned_down) {
  flight_world world({.who = GetParam()});
  world.load(short_mission());
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  world.assign(another_tail(1));
  world.run_for(2);
  ASSERT_EQ(world.answers().size(), 1U);
  EXPECT_EQ(world.answers().front().response.outcome, mission::assignment_outcome::rejected);
  EXPECT_NE(world.answers().front().response.reason.value_or("").find("over"), std::string::npos);
}

TEST_P(rule, a_tail_that_leads_out_of_the_fence_is_turned_down_and_the_plan_before_goes_on) {
  flight_world world({.who = GetParam()});
  auto mission = short_mission();
  mission.geofences = {square(150)};
  ASSERT_TRUE(fly(world, mission));
  world.assign(another_tail(1, 400));
  ASSERT_TRUE(world.run_until([&] { return !world.answers().empty(); }, 30)) << world.story();
  EXPECT_EQ(world.answers().front().response.outcome, mission::assignment_outcome::rejected);
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  EXPECT_EQ(world.durable().mission->revision, 1);
}

TEST_P(rule, a_revision_that_leads_out_of_the_fence_is_not_flown) {
  flight_world world({.who = GetParam()});
  auto mission = short_mission();
  mission.geofences = {square(150)};
  ASSERT_TRUE(fly(world, mission));
  mission.revision = 2;
  mission.items[mission.items.size() - 1] = tests::place(GetParam(), "far", 400, 0);
  world.load(mission);
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  EXPECT_EQ(world.durable().mission->revision, 1);
  EXPECT_TRUE(was_said(world, "can not be flown, and the one before stays")) << world.story();
}

TEST_P(rule, the_fences_of_a_revision_are_watched_from_its_cut_over_on) {
  flight_world world({.who = GetParam()});
  auto mission = short_mission();
  mission.geofences = {square(150)};
  ASSERT_TRUE(fly(world, mission));
  mission.revision = 2;
  mission.geofences = {square(300)};
  world.load(mission);
  ASSERT_TRUE(world.run_until([&] { return world.durable().mission->revision == 2 && !world.durable().doing; }, 60))
      << world.story();
  ASSERT_EQ(world.guarded().size(), 1U);
  EXPECT_EQ(world.guarded().front().vertices, mission.geofences.front().vertices) << world.story();
}

TEST_P(rule, the_fences_of_a_revision_are_watched_also_when_godwit_dies_while_it_comes) {
  for (int moment = 0; moment < 20; ++moment) {
    flight_world world({.who = GetParam()});
    auto mission = short_mission();
    ASSERT_TRUE(fly(world, mission));
    mission.revision = 2;
    mission.geofences = {square(300)};
    world.load(mission);
    ASSERT_TRUE(world.run_until([&] { return world.durable().progress.upload.has_value(); }, 30)) << world.story();
    world.run_for(0.002 * moment);
    moment % 2 == 0 ? world.crash() : world.crash_all();
    world.run_for(10);
    if (world.durable().status.now == phase::paused) {
      EXPECT_TRUE(world.say(command_kind::resume).is_taken) << moment << world.story();
      world.run_for(10);
    }
    if (world.durable().mission->revision == 2) {
      EXPECT_EQ(world.guarded().size(), 1U) << moment << world.story();
    }
  }
}

// Its upload cuts the plan that is flown.
TEST_P(rule, a_vehicle_without_plan_ids_is_held_while_its_plan_is_replaced) {
  flight_world world({.who = GetParam(), .most_delay_ms = 50});
  ASSERT_TRUE(fly(world));
  const auto before = world.commands().size();
  world.assign(another_tail(1));
  ASSERT_TRUE(world.run_until([&] { return world.durable().progress.upload.has_value(); }, 30)) << world.story();
  const bool is_held = world.commands().size() > before && world.commands().back() == set_mode;
  EXPECT_EQ(is_held, GetParam() != sim::personality::px4) << world.story();
}

// The start has opened a generation since its order: that is no sign of a plan which came.
TEST_P(rule, a_replan_that_was_never_sent_has_failed) {
  if (GetParam() != sim::personality::px4)
    return; // all others hold first
  flight_world world({.who = GetParam(), .speed = 1});
  ASSERT_TRUE(fly(world));
  const auto generation = world.durable().progress.last_generation;
  const auto orders = world.orders();
  world.lose_command(io::mavlink::number(io::mavlink::mav_cmd::request_message), 1000);
  world.assign(another_tail(1));
  ASSERT_TRUE(world.run_until([&] { return world.durable().doing.has_value(); }, 5)) << world.story();
  ASSERT_TRUE(world.run_until([&] { return !world.durable().doing; }, 20)) << world.story();
  EXPECT_EQ(world.orders(), orders) << world.story();
  EXPECT_EQ(world.durable().progress.last_generation, generation);
  EXPECT_TRUE(std::ranges::any_of(
      world.said(),
      [](const auto& each) { return each.find("the vehicle goes on with the plan that it has") != std::string::npos; }))
      << world.sentence() << world.story();
}

// DO_SET_MISSION_CURRENT is acknowledged also by a vehicle that holds another plan.
TEST_P(rule, after_a_replan_an_ardupilot_goes_on_only_when_it_shows_the_item_of_the_new_plan) {
  if (GetParam() != sim::personality::ardupilot)
    return;
  flight_world world({.who = GetParam()});
  ASSERT_TRUE(fly(world));
  world.lose_message(io::mavlink::mission_current::message_id);
  world.assign(another_tail(1));
  ASSERT_TRUE(world.run_until([&] { return world.durable().progress.start.has_value(); }, 60)) << world.story();
  const auto commands = world.commands().size();
  EXPECT_TRUE(world.run_until_phase(phase::paused, 40)) << world.story();
  EXPECT_EQ(
      std::count(world.commands().begin() + static_cast<std::ptrdiff_t>(commands), world.commands().end(), set_mode), 0)
      << "it stays held\n"
      << world.story();
  EXPECT_EQ(world.durable().status.cause, pause_cause::not_done) << world.story();
  world.lose_message(0);
  world.run_for(3);
  EXPECT_TRUE(world.say(command_kind::resume).is_taken) << world.story();
  EXPECT_TRUE(world.run_until_phase(phase::done)) << world.story();
}

INSTANTIATE_TEST_SUITE_P(each, rule_of_long_replans, testing::Values(sim::personality::px4));
INSTANTIATE_TEST_SUITE_P(each, rule,
                         testing::Values(sim::personality::px4, sim::personality::ardupilot, sim::personality::rover,
                                         sim::personality::plane));

} // namespace rules_test
} // namespace godwit::executor
