// The process is killed before and after commits of its journal, one flight for each place: the next process goes on,
// and the service gets each report once.
//
// The places are enumerated and not drawn: every n-th commit of a flight without a kill, and with TEST_FULL=1 every
// one of them.
#include <gtest/gtest.h>

#include "programs/godwit-drill/flight_simulation/flight_judge.hpp"
#include "programs/godwit-drill/flight_simulation/flight_people.hpp"
#include "tests/support/run_options.hpp"

namespace process_kill_test {

using namespace godwit;
using namespace godwit::drill;
using namespace godwit::tests;
using side = flight_simulation::side;

struct kill_case {
  sim::personality who;
  side where;
};

class process_kill : public testing::TestWithParam<kill_case> {};

std::uint64_t commits_of_whole_flight(sim::personality who) {
  flight_simulation flight({.who = who});
  EXPECT_TRUE(flight.run_until_phase(executor::phase::done, 300)) << flight.story();
  return flight.commits();
}

TEST_P(process_kill, at_any_commit_of_a_flight_loses_and_doubles_nothing) {
  constexpr std::uint64_t usual_places = 25;
  const auto [who, where] = GetParam();
  const auto last = commits_of_whole_flight(who);
  ASSERT_GT(last, usual_places);
  const auto stride = is_full_run() ? 1 : last / usual_places;
  int kills = 0; // with another order of events a flight can have a few commits less
  for (std::uint64_t commit = 1; commit <= last; commit += stride) {
    flight_simulation flight({.who = who, .seed = commit});
    flight.kill_process_at_commit(commit, where);
    EXPECT_TRUE(fly_with_help(flight)) << "commit " << commit << "\n" << flight.story();
    kills += flight.processes() - 1;
    EXPECT_EQ(flaw_of_reports(flight), "") << "commit " << commit << "\n" << flight.story();
    if (HasFailure())
      return;
  }
  EXPECT_GE(kills, static_cast<int>(last / stride * 8 / 10));
}

// Nobody knows of the flight then, and people may stand where it has come down.
class lost_journal : public testing::TestWithParam<sim::personality> {};

TEST_P(lost_journal, of_a_flight_under_way_starts_nothing_after_its_landing_until_a_person_says_so) {
  flight_simulation flight({.who = GetParam()});
  const auto is_under_way = [&] {
    const auto seen = flight.vehicle().describe();
    return flight.status().now == executor::phase::flying && seen.mission_current >= 2 && seen.ground_speed_mps > 1;
  };
  ASSERT_TRUE(flight.run_until(is_under_way, 120)) << flight.story();
  flight.kill_process();
  flight.outside().journal.actors.clear();
  const auto since_ns = flight.now_ns();
  flight.run_for(90);
  EXPECT_EQ(starts_since(flight, since_ns), 0) << flight.story();
  EXPECT_EQ(flight.status().now, executor::phase::ready) << flight.story();
  EXPECT_FALSE(flight.status().reason.empty()) << flight.story();
  EXPECT_TRUE(start_by_station(flight)) << flight.story();
}

// It stands there already when the next process begins, which can see nothing of the flight but what the service has.
TEST_P(lost_journal, of_a_mission_that_was_begun_before_leaves_its_start_to_a_person) {
  flight_simulation flight({.who = GetParam()});
  ASSERT_TRUE(flight.run_until([&] { return flight.reports().size() >= 2; }, 120)) << flight.story();
  flight.lose_power(120);
  flight.outside().journal.actors.clear();
  flight.run_for(110);
  ASSERT_FALSE(flight.vehicle().describe().in_air) << flight.story();
  const auto since_ns = flight.now_ns();
  flight.run_for(90);
  EXPECT_EQ(starts_since(flight, since_ns), 0) << flight.story();
  EXPECT_TRUE(flight.was_told("another vehicle has flown the mission")) << flight.story();
  EXPECT_TRUE(start_by_station(flight)) << flight.story();
  EXPECT_TRUE(fly_with_help(flight)) << flight.story();
  EXPECT_EQ(flaw_of_reports(flight), "") << flight.story();
}

TEST_P(lost_journal, of_a_flight_that_is_over_does_not_fly_it_again) {
  flight_simulation flight({.who = GetParam()});
  ASSERT_TRUE(flight.run_until_phase(executor::phase::done, 300)) << flight.story();
  const auto reports = flight.reports().size();
  flight.kill_process();
  flight.outside().journal.actors.clear();
  const auto since_ns = flight.now_ns();
  flight.run_for(90);
  EXPECT_EQ(moves_since(flight, since_ns), 0) << flight.story();
  EXPECT_TRUE(has_nothing_to_fly(flight)) << flight.story();
  EXPECT_EQ(flight.reports().size(), reports) << flight.story();
  EXPECT_EQ(flaw_of_reports(flight), "") << flight.story();
}

// The mode of a resume is with the vehicle, and what the failsafe was told of it has to be on the disk by then: else
// the next process takes it for a pilot's, and waits for a person without a reason that is true.
class killed_in_resume : public testing::TestWithParam<sim::personality> {};

TEST_P(killed_in_resume, right_after_its_mode_nobody_is_taken_to_have_the_vehicle) {
  constexpr std::uint64_t orders_of_events = 4; // drawn by the seed
  constexpr double sync_s = 0.5;                // else all that is told at one time is on the disk at once
  for (std::uint64_t seed = 1; seed <= orders_of_events; ++seed) {
    flight_simulation flight({.who = GetParam(), .seed = seed});
    const auto is_under_way = [&] {
      const auto seen = flight.vehicle().describe();
      return flight.status().now == executor::phase::flying && seen.mission_current >= 2 && seen.ground_speed_mps > 1;
    };
    ASSERT_TRUE(flight.run_until(is_under_way, 120)) << flight.story();
    flight.say(operators::command_kind::pause);
    ASSERT_TRUE(flight.run_until_phase(executor::phase::paused, 20)) << flight.story();
    flight.run_for(1);
    flight.slow_journal(sync_s);
    const auto since_ns = flight.now_ns();
    flight.say(operators::command_kind::resume);
    ASSERT_TRUE(flight.run_until([&] { return moves_since(flight, since_ns) > 0; }, 10)) << flight.story();
    flight.kill_process();
    flight.slow_journal(0);
    const auto is_taken = [&] { return executor::needs_hand_back(flight.status().cause); };
    EXPECT_FALSE(flight.run_until(is_taken, 15)) << flight.story();
    EXPECT_TRUE(fly_with_help(flight)) << flight.story();
    EXPECT_EQ(flaw_of_reports(flight), "") << flight.story();
    if (HasFailure())
      return;
  }
}

INSTANTIATE_TEST_SUITE_P(every_vehicle, killed_in_resume,
                         testing::Values(sim::personality::rover, sim::personality::px4, sim::personality::ardupilot,
                                         sim::personality::plane),
                         [](const auto& who) { return std::string(io::name_of(who.param)); });

INSTANTIATE_TEST_SUITE_P(every_vehicle, lost_journal,
                         testing::Values(sim::personality::rover, sim::personality::px4, sim::personality::ardupilot),
                         [](const auto& who) { return std::string(io::name_of(who.param)); });

INSTANTIATE_TEST_SUITE_P(
    every_vehicle, process_kill,
    testing::Values(kill_case{sim::personality::rover, side::before}, kill_case{sim::personality::rover, side::after},
                    kill_case{sim::personality::px4, side::before}, kill_case{sim::personality::px4, side::after},
                    kill_case{sim::personality::ardupilot, side::before},
                    kill_case{sim::personality::ardupilot, side::after},
                    kill_case{sim::personality::plane, side::before}, kill_case{sim::personality::plane, side::after}),
    [](const auto& each) {
      return std::string(io::name_of(each.param.who)) + (each.param.where == side::before ? "_before" : "_behind");
    });

} // namespace process_kill_test
