// A go-to, an insert and a cancel while the missions service is away, on the real composition: the vehicle holds at
// once, the change is flown in time, the service gets it when it is back, and nothing is lost or doubled by that,
// whoever is killed when.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>

#include "programs/godwit-drill/flight_simulation/flight_judge.hpp"
#include "programs/godwit-drill/flight_simulation/flight_people.hpp"
#include "programs/godwit-drill/flight_simulation/short_mission.hpp"
#include "programs/godwit-drill/flight_simulation/vehicle_modes.hpp"
#include "tests/support/run_options.hpp"

namespace unanswered_change_flight_test {

using namespace godwit;
using namespace godwit::drill;
using namespace godwit::tests;
using executor::phase;
using operators::command_kind;
using runtime::crash_point;
using side = flight_simulation::side;

constexpr double away_s = 20;

operators::command sent_there(sim::personality who) {
  operators::command result;
  result.kind = command_kind::go_to;
  result.place = std::get<mission::waypoint>(place(who, "", -40, -20)).at;
  return result;
}

bool is_under_way(const flight_simulation& flight) {
  const auto seen = flight.vehicle().describe();
  return flight.status().now == phase::flying && seen.mission_current >= 2 && seen.ground_speed_mps > 1;
}

// Since the command; nothing: no such order has come to the vehicle.
template <class Is>
std::optional<double> order_after_ms(const flight_simulation& flight, std::int64_t said_ns, Is is_it) {
  for (const auto& each : flight.orders())
    if (each.at_ns >= said_ns && is_it(each))
      return static_cast<double>(each.at_ns - said_ns) * 1e-6;
  return std::nullopt;
}

bool brings_plan(const vehicle_order& each) { return each.message_id == io::mavlink::mission_count::message_id; }

// Its last item is the place to which it was sent, or a part of the mission that came back.
bool service_has_goto(flight_simulation& flight) {
  return mission::id_of(flight.service().mission(flight.mission_id()).items.back()).starts_with("goto");
}

class unanswered_change_flight : public testing::TestWithParam<sim::personality> {
protected:
  static void fly(flight_simulation& flight) {
    ASSERT_TRUE(flight.run_until([&] { return is_under_way(flight) && flight.reports().size() >= 2; }, 120))
        << flight.story();
  }
  // Sent elsewhere while the service is away, and sent back when it is there again.
  static void go_there_and_back(flight_simulation& flight) {
    flight.cut_service(away_s);
    flight.say(sent_there(GetParam()));
    flight.run_for(away_s / 2);
    if (flight.status().now == phase::paused) // it was killed while the plan was replaced: a person goes on
      flight.say(command_kind::resume);
    flight.run_for(away_s / 2 + 5);
    EXPECT_TRUE(service_has_goto(flight)) << flight.story();
    EXPECT_EQ(flight.service().changes(flight.mission_id()), 1U) << flight.story();
    flight.say(command_kind::cancel);
    flight.run_for(6);
    EXPECT_TRUE(fly_with_help(flight)) << flight.story();
    EXPECT_EQ(flight.service().changes(flight.mission_id()), 2U) << flight.story();
    EXPECT_EQ(flaw_of_reports(flight), "") << flight.story();
    EXPECT_EQ(flaw_of_truth(flight), "") << flight.story();
    EXPECT_EQ(flaw_of_place(flight), "") << flight.story();
    for (const auto& each : flight.audit().findings())
      ADD_FAILURE() << each << flight.story();
  }
};

TEST_P(unanswered_change_flight, holds_within_50_ms_is_flown_within_2200_and_told_within_5_s_of_the_return) {
  for (const double speed : {1.0, 10.0}) { // of the vehicle's world
    flight_simulation flight({.who = GetParam(), .speed = speed, .stream_factor = speed == 1 ? 1 : 0.3});
    fly(flight);
    flight.cut_service(away_s);
    const auto said_ns = flight.now_ns();
    flight.say(sent_there(GetParam()));
    flight.run_for(away_s);
    const auto hold = order_after_ms(flight, said_ns, [](const auto& each) { return each.mode.has_value(); });
    ASSERT_TRUE(hold) << flight.story();
    EXPECT_LE(*hold, 50) << flight.story();
    const auto flown = order_after_ms(flight, said_ns, brings_plan);
    ASSERT_TRUE(flown) << flight.story();
    EXPECT_GE(*flown, 2'000) << flight.story();
    EXPECT_LE(*flown, 2'200) << flight.story();
    const auto back_ns = flight.now_ns();
    EXPECT_TRUE(flight.run_until([&] { return service_has_goto(flight); }, 5)) << flight.story();
    std::printf("%s, world %.0f times as fast: held after %.0f ms, flown after %.0f ms, told %.2f s after the return\n",
                std::string(io::name_of(GetParam())).c_str(), speed, *hold, *flown,
                static_cast<double>(flight.now_ns() - back_ns) * 1e-9);
  }
}

TEST_P(unanswered_change_flight, is_told_within_5_s_whenever_the_service_comes_back) {
  double longest_s = 0;
  for (int tenths = 0; tenths < 40; ++tenths) {
    flight_simulation flight({.who = GetParam(), .seed = static_cast<std::uint64_t>(tenths + 1)});
    fly(flight);
    const auto back_ns = flight.now_ns() + static_cast<std::int64_t>((away_s + 0.1 * tenths) * 1e9);
    flight.cut_service(away_s + 0.1 * tenths);
    flight.say(sent_there(GetParam()));
    ASSERT_TRUE(flight.run_until([&] { return service_has_goto(flight); }, 2 * away_s)) << flight.story();
    longest_s = std::max(longest_s, static_cast<double>(flight.now_ns() - back_ns) * 1e-9);
  }
  EXPECT_LE(longest_s, 5);
  std::printf("%s: told at most %.2f s after the return\n", std::string(io::name_of(GetParam())).c_str(), longest_s);
}

TEST_P(unanswered_change_flight, goes_back_to_its_mission_and_all_is_reported) {
  flight_simulation flight({.who = GetParam()});
  fly(flight);
  go_there_and_back(flight);
}

TEST_P(unanswered_change_flight, an_insert_and_two_places_follow_each_other_before_the_service_is_back) {
  flight_simulation flight({.who = GetParam()});
  fly(flight);
  flight.cut_service(3 * away_s);
  auto extra = sent_there(GetParam());
  extra.kind = command_kind::insert;
  flight.say(extra);
  flight.run_for(6);
  flight.say(sent_there(GetParam()));
  flight.run_for(12);
  flight.say(command_kind::cancel);
  flight.run_for(3 * away_s);
  EXPECT_TRUE(fly_with_help(flight)) << flight.story();
  EXPECT_EQ(flight.service().changes(flight.mission_id()), 3U) << flight.story();
  EXPECT_EQ(flaw_of_reports(flight), "") << flight.story();
  EXPECT_EQ(flaw_of_place(flight), "") << flight.story();
}

TEST_P(unanswered_change_flight, gives_way_to_what_somebody_has_made_of_the_mission_meanwhile) {
  flight_simulation flight({.who = GetParam()});
  fly(flight);
  flight.cut_service(away_s);
  flight.say(sent_there(GetParam()));
  flight.run_for(5);
  flight.service().revise(flight.mission_id(), place(GetParam(), "theirs", 30, 30));
  EXPECT_TRUE(fly_with_help(flight)) << flight.story();
  EXPECT_EQ(flight.service().changes(flight.mission_id()), 0U) << flight.story();
  EXPECT_EQ(flaw_of_reports(flight), "") << flight.story();
  EXPECT_EQ(flaw_of_place(flight), "") << flight.story();
  const auto reports = flight.reports();
  EXPECT_TRUE(std::ranges::any_of(reports, [](const auto& each) { return each.item_id == "theirs"; }))
      << flight.story();
}

// A takeover at any time of it: what comes of the change is never begun without a person.
TEST_P(unanswered_change_flight, that_a_pilot_ends_moves_nothing_until_a_person_goes_on) {
  for (const double after_s : {0.05, 0.5, 1.0, 1.5, 1.9, 2.05, 2.1, 2.2, 2.5}) {
    SCOPED_TRACE(after_s);
    flight_simulation flight({.who = GetParam()});
    fly(flight);
    flight.cut_service(away_s);
    flight.say(sent_there(GetParam()));
    flight.run_for(after_s);
    flight.switch_mode(pilot_mode(GetParam()));
    ASSERT_TRUE(flight.run_until([&] { return flight.status().cause == executor::pause_cause::taken_over; }, 8))
        << flight.story();
    flight.run_for(0.5);
    const auto since_ns = flight.now_ns();
    flight.run_for(5);
    EXPECT_EQ(moves_since(flight, since_ns), 0) << flight.story();
    flight.say(command_kind::hand_back);
    flight.run_for(8);
    EXPECT_EQ(missions_started_since(flight, since_ns), 0) << flight.story();
    for (const auto& each : flight.audit().findings())
      ADD_FAILURE() << each << flight.story();
  }
}

TEST_P(unanswered_change_flight, loses_and_doubles_nothing_when_an_actor_throws_at_any_time_of_it) {
  int flights = 0;
  for (const auto* actor : {"executor", "mission_client"})
    for (const auto point : {crash_point::before_handler, crash_point::after_handler, crash_point::after_commit,
                             crash_point::before_dispatch})
      for (const double after_s : {0.0025, 0.3, 1.0, 1.95, 2.0, 2.1, 2.5, 10.0, away_s}) {
        SCOPED_TRACE(std::string(actor) + " at point " + std::to_string(static_cast<int>(point)) + " after " +
                     std::to_string(after_s) + " s");
        flight_simulation flight({.who = GetParam(), .seed = static_cast<std::uint64_t>(++flights)});
        fly(flight);
        flight.cut_service(away_s);
        flight.say(sent_there(GetParam()));
        flight.run_for(after_s); // the first one: it is just taken
        flight.process()->crash_at(actor, point);
        flight.run_for(away_s + 5 - after_s);
        EXPECT_TRUE(service_has_goto(flight)) << flight.story();
        flight.say(command_kind::cancel);
        flight.run_for(6);
        EXPECT_TRUE(fly_with_help(flight)) << flight.story();
        EXPECT_EQ(flight.service().changes(flight.mission_id()), 2U) << flight.story();
        EXPECT_EQ(flaw_of_reports(flight), "") << flight.story();
        if (HasFailure())
          return;
      }
}

// Each commit from the command to the end of the mission, before and after it.
TEST_P(unanswered_change_flight, loses_and_doubles_nothing_when_the_process_is_killed_at_any_commit_of_it) {
  std::uint64_t first = 0;
  std::uint64_t last = 0;
  {
    flight_simulation flight({.who = GetParam()});
    fly(flight);
    first = flight.commits() + 1;
    go_there_and_back(flight);
    last = flight.commits();
  }
  const auto stride = is_full_run() ? 1 : 4;
  int kills = 0;
  for (auto commit = first; commit <= last; commit += stride)
    for (const auto where : {side::before, side::after}) {
      SCOPED_TRACE("commit " + std::to_string(commit) + (where == side::before ? ", before" : ", after"));
      flight_simulation flight({.who = GetParam(), .seed = commit});
      fly(flight);
      if (flight.commits() >= commit) // in another order of events
        continue;
      flight.kill_process_at_commit(commit, where);
      go_there_and_back(flight);
      kills += flight.processes() - 1;
      if (HasFailure())
        return;
    }
  std::printf("%s: %d kills, nothing lost, nothing doubled\n", std::string(io::name_of(GetParam())).c_str(), kills);
}

INSTANTIATE_TEST_SUITE_P(each, unanswered_change_flight,
                         testing::Values(sim::personality::rover, sim::personality::px4, sim::personality::ardupilot),
                         [](const auto& each) { return std::string(io::name_of(each.param)); });

} // namespace unanswered_change_flight_test
