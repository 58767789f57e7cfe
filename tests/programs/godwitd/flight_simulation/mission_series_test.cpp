// One daemon, many missions: it asks the service for the next one, flies it when an operator starts it, delivers, and
// asks again, whatever is killed meanwhile.
#include <gtest/gtest.h>

#include <array>
#include <iostream>
#include <random>
#include <string>
#include <vector>

#include "actors/domain/mission/convert/conversion.hpp"
#include "programs/godwit-drill/flight_simulation/flight_judge.hpp"
#include "programs/godwit-drill/flight_simulation/short_mission.hpp"
#include "tests/support/run_options.hpp"
#include "tests/support/station_items.hpp"

namespace mission_series_test {

using namespace godwit;
using namespace godwit::drill;
using executor::phase;
using operators::command_kind;

mission::document mission_of(sim::personality who, int number) {
  auto result = short_mission(who);
  result.mission_id = mission::uuid_of_text("mission " + std::to_string(number) + " of a series");
  return result;
}

std::vector<std::string> add_missions(flight_simulation& flight, int count) {
  std::vector<std::string> result{flight.mission_id()};
  for (int i = 1; i < count; ++i) {
    const auto each = mission_of(flight.who(), i);
    flight.service().add_mission(each, flight.now_ns());
    result.push_back(each.mission_id);
  }
  return result;
}

bool is_complete(flight_simulation& flight, const std::string& mission_id) {
  const auto reports = flight.reports_of(mission_id);
  return !reports.empty() && reports.back().kind == mission::progress_kind::complete;
}

// An operator who starts what is ready, and lets go on what waits after a restart.
void help(flight_simulation& flight) {
  const auto& at = flight.status();
  if (!flight.vehicle().describe().in_air)
    flight.vehicle().set_battery(100, flight.now_ns());
  if (executor::needs_hand_back(at.cause))
    flight.say(command_kind::hand_back);
  else if (at.now == phase::paused)
    flight.say(command_kind::resume);
  else if (at.now == phase::ready)
    flight.say(command_kind::start);
}

// Until MISSION_ID is complete. DISTURB is called twice a second.
template <class Disturb>
bool fly(flight_simulation& flight, const std::string& mission_id, Disturb disturb) {
  constexpr int most_half_seconds = 1'200;
  for (int i = 0; i < most_half_seconds && !is_complete(flight, mission_id); ++i) {
    flight.run_for(0.5);
    disturb();
    constexpr int help_every = 6;
    if (i % help_every == 0)
      help(flight);
  }
  return is_complete(flight, mission_id);
}

class mission_series : public testing::TestWithParam<sim::personality> {};

TEST_P(mission_series, is_flown_one_after_the_other_each_with_reports_of_its_own) {
  flight_simulation flight({.who = GetParam(), .starts_by_itself = false, .takes_next = true, .is_recorded = true});
  const auto ids = add_missions(flight, 3);
  for (const auto& each : ids) {
    ASSERT_TRUE(fly(flight, each, [] {})) << flight.story();
    EXPECT_EQ(flaw_of_mission(flight, each), "") << flight.story();
  }
  ASSERT_TRUE(flight.run_until_phase(phase::done, 60)) << flight.story();
  EXPECT_TRUE(flight.record().broken().empty()) << flight.record().broken().front();
}

TEST_P(mission_series, twenty_in_a_row_with_thirty_kills_are_complete_and_their_reports_gapless) {
  constexpr int missions = 20;
  constexpr int kills_each = 2;
  constexpr int least_kills = 30; // a mission may be over before its last
  constexpr std::array victims{"executor", "mission_client", "vehicle_link", "mapobjects_store", "failsafe"};
  const auto seed = tests::first_seed();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 test_rng(seed);
  flight_simulation flight(
      {.who = GetParam(), .seed = seed, .starts_by_itself = false, .takes_next = true, .is_recorded = true});
  const auto ids = add_missions(flight, missions);
  int process_kills = 0;
  int actor_kills = 0;
  int left = 0;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    left += kills_each;
    const auto kill = [&] {
      constexpr std::uint64_t once_in = 6; // half seconds
      if (left == 0 || flight.process() == nullptr || test_rng() % once_in != 0)
        return;
      const bool takes_all = (process_kills + actor_kills) % 2 == 0;
      if (takes_all)
        flight.kill_process();
      else if (!flight.process()->kill(victims[test_rng() % victims.size()]))
        return;
      ++(takes_all ? process_kills : actor_kills);
      --left;
    };
    ASSERT_TRUE(fly(flight, ids[i], kill)) << "mission " << i << "\n" << flight.story();
    flight.forget_abnormal_ends(); // so many kills within minutes are the test's
  }
  for (const auto& each : ids)
    EXPECT_EQ(flaw_of_mission(flight, each), "") << each << "\n" << flight.story();
  EXPECT_GE(process_kills + actor_kills, least_kills);
  EXPECT_EQ(flight.service().answers_to_reports(422), 0U);
  EXPECT_TRUE(flight.record().broken().empty()) << flight.record().broken().front();
  std::cout << process_kills << " kills of the process, " << actor_kills << " of actors, "
            << flight.now_ns() / 1'000'000'000 << " s of flight\n";
}

TEST_P(mission_series, after_a_mission_that_was_called_off_the_next_waits_for_a_person_also_with_automatic) {
  flight_simulation flight({.who = GetParam(), .takes_next = true});
  const auto ids = add_missions(flight, 2);
  ASSERT_TRUE(flight.run_until([&] { return flight.reports_of(ids[0]).size() >= 3; }, 120)) << flight.story();
  flight.say(command_kind::come_home);
  const auto is_next_ready = [&] {
    return flight.status().now == phase::ready && flight.was_told("mission " + ids[1]);
  };
  ASSERT_TRUE(flight.run_until_phase(phase::aborted, 120)) << flight.story();
  (void)flight.run_until(is_next_ready, 60);
  ASSERT_EQ(flight.status().now, phase::ready) << flight.story();
  const auto since_ns = flight.now_ns();
  flight.run_for(60);
  EXPECT_EQ(starts_since(flight, since_ns), 0) << flight.story();
  EXPECT_TRUE(flight.reports_of(ids[1]).empty());
  EXPECT_TRUE(fly(flight, ids[1], [] {})) << flight.story();
}

// The service hears nothing of it, whatever is killed in its flight.
TEST_P(mission_series, a_stations_plan_is_flown_between_two_missions_of_the_service) {
  flight_simulation flight({.who = GetParam(),
                            .starts_by_itself = false,
                            .speaks_as_autopilot = true,
                            .takes_next = true,
                            .is_recorded = true});
  ASSERT_TRUE(fly(flight, flight.mission_id(), [] {})) << flight.story();
  ASSERT_TRUE(flight.run_until_phase(phase::done, 60)) << flight.story();
  flight.station().upload(tests::station_items(GetParam()));
  ASSERT_TRUE(flight.run_until([&] { return flight.station().plan_answer().has_value(); }, 10)) << flight.story();
  EXPECT_EQ(flight.station().plan_answer(), std::uint8_t{0}) << flight.story();
  ASSERT_TRUE(flight.run_until_phase(phase::ready, 120)) << flight.story();
  flight.vehicle().set_battery(100, flight.now_ns());
  flight.station().start_mission(0, 0);
  ASSERT_TRUE(flight.run_until_phase(phase::flying, 60)) << flight.story();
  for (const auto* each : {"executor", "mission_client"}) {
    flight.run_for(3);
    (void)flight.process()->kill(each);
  }
  flight.run_for(3);
  flight.kill_process();
  ASSERT_TRUE(flight.run_until_phase(phase::done, 300)) << flight.story();
  for (const auto status : {404U, 409U, 410U, 422U})
    EXPECT_EQ(flight.service().answers_to_reports(status), 0U) << status;
  const auto next = mission_of(GetParam(), 1);
  flight.service().add_mission(next, flight.now_ns());
  ASSERT_TRUE(fly(flight, next.mission_id, [] {})) << flight.story();
  for (const auto& each : {flight.mission_id(), next.mission_id})
    EXPECT_EQ(flaw_of_mission(flight, each), "") << flight.story();
  EXPECT_TRUE(flight.record().broken().empty()) << flight.record().broken().front();
}

// An ArduPilot's copter is not armed in AUTO, in which its mission has left it.
class armed_between_missions : public mission_series {};

TEST_P(armed_between_missions, by_a_person_the_vehicle_is_not_started_by_the_next) {
  flight_simulation flight({.who = GetParam(), .takes_next = true});
  ASSERT_TRUE(flight.run_until_phase(phase::done, 300)) << flight.story();
  flight.person().arm();
  flight.run_for(1);
  ASSERT_TRUE(flight.vehicle().describe().armed) << flight.story();
  const auto since_ns = flight.now_ns();
  const auto next = mission_of(GetParam(), 1);
  flight.service().add_mission(next, flight.now_ns());
  (void)flight.run_until([&] { return !flight.vehicle().describe().armed; }, 60); // some disarm by themselves
  EXPECT_EQ(starts_since(flight, since_ns), 0) << flight.story();
  EXPECT_TRUE(flight.reports_of(next.mission_id).empty());
}

INSTANTIATE_TEST_SUITE_P(every_vehicle, mission_series,
                         testing::Values(sim::personality::px4, sim::personality::ardupilot, sim::personality::rover),
                         [](const auto& each) { return std::string(io::name_of(each.param)); });

INSTANTIATE_TEST_SUITE_P(every_vehicle, armed_between_missions,
                         testing::Values(sim::personality::px4, sim::personality::rover),
                         [](const auto& each) { return std::string(io::name_of(each.param)); });

} // namespace mission_series_test
