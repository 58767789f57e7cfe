// A go-to, an insert or a cancel that the missions service does not answer: it is flown after a while, unless something
// else has ended it, and the service gets it before all reports of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "actors/executor/remaining.hpp"
#include "tests/actors/executor/flight_world.hpp"
#include "tests/support/vehicle_modes.hpp"

namespace unanswered_change_test {

using namespace godwit;
using namespace godwit::tests;
using executor::change_kind;
using executor::pause_cause;
using executor::phase;
using mission::progress_kind;
using mission_client::change_verdict;
using operators::command_kind;

constexpr double second_ns = 1e9;

operators::command place_for(command_kind kind, sim::personality who, double north_m = -40, double east_m = -20) {
  operators::command result;
  result.kind = kind;
  result.place = std::get<mission::waypoint>(tests::place(who, "", north_m, east_m)).at;
  return result;
}

bool is_told(const flight_world& world, progress_kind kind, const std::string& name) {
  return std::ranges::any_of(world.reports(), [&](const auto& each) {
    return each.kind == kind && each.item_id && each.item_id->starts_with(name);
  });
}
bool is_reached(const flight_world& world, const std::string& name) {
  return is_told(world, progress_kind::reached, name);
}
// It stays there for an hour.
bool is_sent_there(const flight_world& world) { return is_told(world, progress_kind::started, "goto"); }

bool was_said(const flight_world& world, const std::string& words) {
  return std::ranges::any_of(world.said(), [&](const auto& each) { return each.find(words) != std::string::npos; });
}

double seconds(std::int64_t ns) { return static_cast<double>(ns) / second_ns; }

class unanswered_change : public testing::TestWithParam<sim::personality> {
protected:
  // It has reached the first waypoint, and the service has fallen silent.
  static void fly(flight_world& world) {
    world.load(tests::short_mission(GetParam()));
    ASSERT_TRUE(world.run_until([&] { return is_reached(world, "w1"); }, 600)) << world.story();
    world.silence_service(true);
  }
  static void say(flight_world& world, const operators::command& what) {
    const auto answer = world.say(what);
    ASSERT_TRUE(answer.is_taken) << answer.reason << world.story();
  }
  static void go_there(flight_world& world) { say(world, place_for(command_kind::go_to, GetParam())); }
  // It flies what the service has not answered.
  static void go_there_unanswered(flight_world& world) {
    go_there(world);
    ASSERT_TRUE(world.run_until([&] { return is_on_way(world); }, 20)) << world.story();
  }
  static bool is_on_way(const flight_world& world) {
    return world.durable().mission->revision == 2 && world.durable().status.now == phase::flying;
  }
  static const std::string& flown_key(const flight_world& world) { return world.flown_changes().back().key; }
};

TEST_P(unanswered_change, holds_at_once_and_is_flown_two_seconds_after_the_command) {
  flight_world world({.who = GetParam()});
  fly(world);
  const auto said_ns = world.now_ns();
  const auto commands = world.commands().size();
  go_there(world);
  ASSERT_GT(world.commands().size(), commands) << "it is told to hold in the same instant\n" << world.story();
  ASSERT_TRUE(world.run_until([&] { return !world.flown_changes().empty(); }, 20)) << world.story();
  const auto waited_s = seconds(world.now_ns() - said_ns);
  const auto asked_s = seconds(world.asked_changes().back().at_ns - said_ns);
  EXPECT_GE(waited_s, 2) << world.story();
  EXPECT_LE(waited_s, std::max(2.0, asked_s + 0.5) + 0.2) << world.story();
  EXPECT_EQ(flown_key(world), world.asked_changes().back().key) << "the service knows a repetition by it";
  ASSERT_TRUE(world.run_until([&] { return is_sent_there(world); }, 120)) << world.story();
  EXPECT_TRUE(was_said(world, "has not answered within 2000 ms: the change is flown")) << world.story();
}

TEST_P(unanswered_change, goes_to_the_service_before_all_reports_that_name_its_items_or_its_revision) {
  flight_world world({.who = GetParam()});
  fly(world);
  go_there_unanswered(world);
  ASSERT_TRUE(world.run_until([&] { return is_sent_there(world); }, 120)) << world.story();
  ASSERT_EQ(world.flown_changes().size(), 1U);
  const auto first = std::ranges::find_if(world.reports(), [](const auto& each) { return each.revision == 2; });
  ASSERT_NE(first, world.reports().end()) << world.story();
  EXPECT_GE(static_cast<std::size_t>(first - world.reports().begin()), world.flown_changes().front().after_reports);
}

TEST_P(unanswered_change, that_the_service_answers_in_time_is_flown_as_the_service_has_it_and_no_second_time) {
  flight_world world({.who = GetParam()});
  fly(world);
  world.silence_service(false);
  go_there(world);
  ASSERT_TRUE(world.run_until([&] { return is_sent_there(world); }, 120)) << world.story();
  EXPECT_TRUE(world.flown_changes().empty()) << world.story();
  EXPECT_EQ(world.durable().mission->revision, 2);
}

TEST_P(unanswered_change, that_is_refused_in_time_holds_and_is_never_flown) {
  flight_world world({.who = GetParam()});
  fly(world);
  world.silence_service(false);
  world.set_changes(change_verdict::refused);
  go_there(world);
  world.run_for(15);
  EXPECT_EQ(world.durable().status.now, phase::paused) << world.story();
  EXPECT_TRUE(world.flown_changes().empty()) << world.story();
  EXPECT_EQ(world.durable().mission->revision, 1) << world.story();
}

TEST_P(unanswered_change, waits_for_ever_where_changes_need_the_service) {
  flight_world world({.who = GetParam(), .changes_need_service = true});
  fly(world);
  go_there(world);
  world.run_for(30);
  EXPECT_EQ(world.durable().status.now, phase::paused) << world.story();
  EXPECT_TRUE(world.flown_changes().empty()) << world.story();
  ASSERT_TRUE(world.durable().change) << "a late answer is flown";
}

TEST_P(unanswered_change, is_not_flown_after_a_pause_a_resume_or_a_return_in_between) {
  for (const auto kind : {command_kind::pause, command_kind::resume, command_kind::come_home}) {
    SCOPED_TRACE(io::name_of(kind));
    flight_world world({.who = GetParam()});
    fly(world);
    go_there(world);
    ASSERT_TRUE(world.run_until([&] { return world.durable().change.has_value(); }, 8)) << world.story();
    ASSERT_TRUE(world.say(kind).is_taken) << world.story();
    world.run_for(20);
    EXPECT_TRUE(world.flown_changes().empty()) << world.story();
    EXPECT_FALSE(is_sent_there(world)) << world.story();
    EXPECT_FALSE(world.durable().change) << world.story();
  }
}

// Both are due in the same moment: as soon as the vehicle has refused what a station wants of it.
TEST_P(unanswered_change, that_is_due_together_with_a_resume_is_not_flown) {
  flight_world world({.who = GetParam()});
  fly(world);
  go_there(world);
  ASSERT_TRUE(world.run_until([&] { return world.durable().change.has_value(); }, 8)) << world.story();
  const auto until_ns = world.durable().change->said_ns + 2'000'000'000;
  ASSERT_TRUE(world.run_until([&] { return world.wall_ns() >= until_ns - 300'000'000; }, 8)) << world.story();
  const auto number = world.station_commands(executor::act_kind::stop);
  world.run_for(0.8);
  ASSERT_TRUE(world.flown_changes().empty()) << "who has the vehicle is not known\n" << world.story();
  ASSERT_TRUE(world.say(command_kind::resume).is_taken) << world.story();
  world.vehicle_answers(number, true);
  world.run_for(10);
  EXPECT_TRUE(world.flown_changes().empty()) << world.story();
  EXPECT_FALSE(is_sent_there(world)) << world.story();
}

TEST_P(unanswered_change, is_not_flown_after_a_takeover_in_between_also_when_the_vehicle_is_handed_back) {
  for (const bool crashes : {false, true}) {
    flight_world world({.who = GetParam()});
    fly(world);
    go_there(world);
    ASSERT_TRUE(world.run_until([&] { return world.durable().change.has_value(); }, 8)) << world.story();
    world.switch_mode(pilot_mode(GetParam()));
    ASSERT_TRUE(world.run_until([&] { return world.durable().status.cause == pause_cause::taken_over; }, 8))
        << world.story();
    if (crashes)
      world.crash();
    const auto orders = world.orders();
    world.run_for(5);
    ASSERT_TRUE(world.say(command_kind::hand_back).is_taken) << world.story();
    world.run_for(10);
    EXPECT_EQ(world.orders(), orders) << world.story();
    EXPECT_TRUE(world.flown_changes().empty()) << world.story();
    EXPECT_FALSE(world.durable().change) << world.story();
  }
}

// Its plan comes to the vehicle then, and a person goes on with it.
TEST_P(unanswered_change, that_a_pause_or_a_takeover_meets_on_its_way_to_the_vehicle_is_not_begun) {
  for (const bool takes_over : {false, true}) {
    SCOPED_TRACE(takes_over);
    flight_world world({.who = GetParam()});
    fly(world);
    go_there(world);
    ASSERT_TRUE(world.run_until([&] { return world.durable().change && world.durable().change->is_flown; }, 20))
        << world.story();
    if (takes_over) {
      world.switch_mode(pilot_mode(GetParam()));
      ASSERT_TRUE(world.run_until([&] { return world.durable().status.cause == pause_cause::taken_over; }, 8))
          << world.story();
      world.run_for(2);
      ASSERT_TRUE(world.say(command_kind::hand_back).is_taken) << world.story();
    } else {
      ASSERT_TRUE(world.say(command_kind::pause).is_taken) << world.story();
    }
    const auto starts = world.starts();
    world.run_for(15);
    EXPECT_EQ(world.starts(), starts) << world.story();
    EXPECT_EQ(world.durable().status.now, phase::paused) << world.story();
    ASSERT_TRUE(world.say(command_kind::resume).is_taken) << world.story();
    EXPECT_TRUE(world.run_until([&] { return is_sent_there(world); }, 120)) << world.story();
  }
}

// The same of one that the service has answered.
TEST_P(unanswered_change, answered_while_somebody_else_has_the_vehicle_is_not_begun_by_a_hand_back) {
  flight_world world({.who = GetParam(), .changes_need_service = true});
  fly(world);
  go_there(world);
  ASSERT_TRUE(world.run_until([&] { return world.durable().change.has_value(); }, 8)) << world.story();
  auto revised = *world.durable().mission;
  revised.revision = 2;
  revised.items = world.durable().change->items;
  world.load(revised);
  world.switch_mode(pilot_mode(GetParam()));
  ASSERT_TRUE(world.run_until([&] { return world.durable().status.cause == pause_cause::taken_over; }, 8))
      << world.story();
  const auto starts = world.starts();
  world.run_for(3);
  ASSERT_TRUE(world.say(command_kind::hand_back).is_taken) << world.story();
  world.run_for(15);
  EXPECT_EQ(world.starts(), starts) << world.story();
  EXPECT_EQ(world.durable().status.now, phase::paused) << world.story();
}

TEST_P(unanswered_change, is_flown_also_when_the_executor_or_the_process_has_crashed_meanwhile) {
  for (const bool whole : {false, true})
    for (const double after_s : {0.1, 1.0, 1.9, 2.05, 2.3}) {
      SCOPED_TRACE(std::to_string(after_s) + (whole ? " s, the process" : " s"));
      flight_world world({.who = GetParam()});
      fly(world);
      go_there(world);
      ASSERT_TRUE(world.run_until([&] { return world.durable().change.has_value(); }, 8)) << world.story();
      world.run_for(after_s);
      whole ? world.crash_all() : world.crash();
      ASSERT_TRUE(world.run_until([&] { return !world.flown_changes().empty(); }, 20)) << world.story();
      world.run_for(10);
      if (world.durable().status.now == phase::paused) { // it was killed while it replaced the plan
        ASSERT_TRUE(world.say(command_kind::resume).is_taken) << world.story();
      }
      EXPECT_TRUE(world.run_until([&] { return is_sent_there(world); }, 120)) << world.story();
      EXPECT_EQ(world.durable().mission->revision, 2) << world.story();
      EXPECT_EQ(world.flown_changes().size(), 1U) << world.story();
    }
}

// Before the vehicle holds, and so before the service is asked.
TEST_P(unanswered_change, is_not_forgotten_by_a_crash_right_after_the_command) {
  for (const bool whole : {false, true})
    for (const auto kind : {command_kind::go_to, command_kind::insert}) {
      SCOPED_TRACE(std::string(io::name_of(kind)) + (whole ? ", the process" : ""));
      flight_world world({.who = GetParam()});
      fly(world);
      say(world, place_for(kind, GetParam()));
      whole ? world.crash_all() : world.crash();
      ASSERT_TRUE(world.run_until([&] { return !world.flown_changes().empty(); }, 20)) << world.story();
      EXPECT_FALSE(world.durable().commanded);
      EXPECT_EQ(world.asked_changes().size(), 1U) << "once\n" << world.story();
    }
}

TEST_P(unanswered_change, that_a_takeover_or_a_pause_has_ended_is_forgotten_also_by_the_next_incarnation) {
  for (const bool takes_over : {false, true}) {
    flight_world world({.who = GetParam()});
    fly(world);
    world.lose_command(io::mavlink::number(io::mavlink::mav_cmd::do_set_mode), 12); // the hold takes its time
    go_there(world);
    ASSERT_TRUE(world.durable().commanded);
    if (takes_over) {
      world.switch_mode(pilot_mode(GetParam()));
      ASSERT_TRUE(world.run_until([&] { return world.durable().status.cause == pause_cause::taken_over; }, 8))
          << world.story();
    } else {
      ASSERT_TRUE(world.say(command_kind::pause).is_taken) << world.story();
    }
    world.crash();
    world.run_for(5);
    if (takes_over) {
      ASSERT_TRUE(world.say(command_kind::hand_back).is_taken) << world.story();
    }
    world.run_for(10);
    EXPECT_TRUE(world.flown_changes().empty()) << world.story();
    EXPECT_FALSE(world.durable().commanded) << world.story();
    EXPECT_FALSE(is_sent_there(world)) << world.story();
  }
}

// Whoever comes back so late does not surprise the people below.
TEST_P(unanswered_change, that_was_commanded_half_a_minute_ago_is_not_flown) {
  flight_world world({.who = GetParam()});
  fly(world);
  go_there(world);
  ASSERT_TRUE(world.run_until([&] { return world.durable().change.has_value(); }, 8)) << world.story();
  world.cut_line(40);
  world.run_for(1);
  world.crash_all();
  world.run_for(60);
  EXPECT_TRUE(world.flown_changes().empty()) << world.story();
  EXPECT_FALSE(world.durable().change) << world.story();
  EXPECT_TRUE(was_said(world, "commanded too long ago")) << world.story();
}

// Its way begins where the vehicle stands: then the service still has half a second.
TEST_P(unanswered_change, between_fences_the_vehicle_stands_first) {
  for (const bool has_fence : {false, true}) {
    flight_world world({.who = GetParam(), .speed = 1});
    auto mission = tests::short_mission(GetParam());
    mission.geofences.clear();
    if (has_fence)
      mission.geofences.push_back(fence_around(GetParam() == sim::personality::plane ? 2'000 : 250));
    world.load(mission);
    ASSERT_TRUE(world.acknowledge() || GetParam() != sim::personality::plane);
    ASSERT_TRUE(world.run_until([&] { return is_reached(world, "w1"); }, 600)) << world.story();
    world.run_for(2);
    world.silence_service(true);
    const auto said_ns = world.now_ns();
    go_there(world);
    ASSERT_TRUE(world.run_until([&] { return !world.flown_changes().empty(); }, 20)) << world.story();
    const auto flown_s = seconds(world.now_ns() - said_ns);
    const auto asked_s = seconds(world.asked_changes().back().at_ns - said_ns);
    EXPECT_NEAR(flown_s, has_fence ? std::max(2.0, asked_s + 0.5) : 2.0, 0.2) << world.story();
  }
}

TEST_P(unanswered_change, that_the_service_takes_later_changes_nothing_on_board) {
  flight_world world({.who = GetParam()});
  fly(world);
  go_there_unanswered(world);
  const auto generation = world.durable().progress.last_generation;
  world.answer_change(flown_key(world), change_verdict::done);
  world.load(*world.durable().mission); // as the service sends it
  world.run_for(5);
  EXPECT_TRUE(world.durable().flown_changes.empty()) << world.story();
  EXPECT_EQ(world.durable().progress.last_generation, generation) << world.story();
}

TEST_P(unanswered_change, gives_way_to_another_revision_of_the_service_also_under_the_same_number) {
  flight_world world({.who = GetParam()});
  const auto mission = tests::short_mission(GetParam());
  fly(world);
  go_there_unanswered(world);
  world.answer_change(flown_key(world), change_verdict::stale, "it has revision 2");
  EXPECT_TRUE(world.durable().flown_changes.empty());
  auto others = mission;
  others.revision = 2;
  others.items.insert(others.items.begin() + 2, tests::place(GetParam(), "theirs", 15, 30));
  world.load(others);
  ASSERT_TRUE(world.run_until([&] { return is_reached(world, "theirs"); }, 240)) << world.story();
  EXPECT_EQ(world.durable().mission->items, others.items) << world.story();
  EXPECT_EQ(world.durable().mission->revision, 2);
}

TEST_P(unanswered_change, gives_way_to_a_revision_that_comes_while_its_plan_goes_to_the_vehicle) {
  flight_world world({.who = GetParam()});
  const auto mission = tests::short_mission(GetParam());
  fly(world);
  go_there(world);
  ASSERT_TRUE(world.run_until([&] { return world.is_uploading() && !world.flown_changes().empty(); }, 20))
      << world.story();
  auto others = mission;
  others.revision = 2;
  others.items.insert(others.items.begin() + 2, tests::place(GetParam(), "theirs", 15, 30));
  world.load(others);
  world.answer_change(flown_key(world), change_verdict::stale, "it has revision 2");
  ASSERT_TRUE(world.run_until([&] { return is_reached(world, "theirs"); }, 240)) << world.story();
}

// One in time: nothing of it is on its way to the vehicle.
TEST_P(unanswered_change, that_is_refused_too_late_is_flown_on_and_can_be_cancelled) {
  flight_world world({.who = GetParam()});
  fly(world);
  go_there_unanswered(world);
  world.answer_change(flown_key(world), change_verdict::refused, "it will not have it");
  EXPECT_TRUE(was_said(world, "does not have the change")) << world.story();
  EXPECT_EQ(world.durable().mission->revision, 1) << "the service's next one is 2";
  ASSERT_TRUE(world.run_until([&] { return is_sent_there(world); }, 120)) << world.story();
  ASSERT_TRUE(world.say(command_kind::cancel).is_taken) << world.story();
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
  EXPECT_TRUE(is_reached(world, "w3")) << world.story();
}

TEST_P(unanswered_change, follows_another_one_before_the_service_has_answered_and_names_its_revision) {
  flight_world world({.who = GetParam()});
  fly(world);
  go_there_unanswered(world);
  world.run_for(3);
  say(world, place_for(command_kind::cancel, GetParam()));
  ASSERT_TRUE(world.run_until([&] { return world.durable().mission->revision == 3; }, 30)) << world.story();
  ASSERT_EQ(world.flown_changes().size(), 2U) << world.story();
  world.answer_change(world.flown_changes().front().key, change_verdict::stale, "it has another");
  EXPECT_EQ(world.durable().mission->revision, 1) << "none of ours counts: " << world.story();
  EXPECT_TRUE(world.durable().flown_changes.empty());
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
}

TEST_P(unanswered_change, an_insert_is_flown_too_and_the_mission_goes_on_meanwhile) {
  flight_world world({.who = GetParam()});
  fly(world);
  auto command = place_for(command_kind::insert, GetParam());
  command.after = "w2";
  say(world, command);
  EXPECT_EQ(world.durable().status.now, phase::flying) << "it does not hold";
  ASSERT_TRUE(world.run_until([&] { return is_reached(world, "extra"); }, 240)) << world.story();
  EXPECT_EQ(world.flown_changes().size(), 1U);
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
}

TEST_P(unanswered_change, that_can_not_be_flown_any_more_when_the_wait_is_over_is_not_flown) {
  flight_world world({.who = GetParam()});
  fly(world);
  go_there(world);
  ASSERT_TRUE(world.run_until([&] { return world.durable().change.has_value(); }, 8)) << world.story();
  world.set_home_by_hand({60, 10, 0}); // which is farther from there than the limits allow
  world.run_for(10);
  EXPECT_TRUE(world.flown_changes().empty()) << world.story();
  EXPECT_NE(world.durable().status.now, phase::flying) << world.story();
  EXPECT_FALSE(is_sent_there(world)) << world.story();
}

INSTANTIATE_TEST_SUITE_P(each, unanswered_change,
                         testing::Values(sim::personality::px4, sim::personality::ardupilot, sim::personality::rover,
                                         sim::personality::plane),
                         [](const auto& each) { return std::string(io::name_of(each.param)); });

} // namespace unanswered_change_test
