// Points of interest in whole flights: from the feed of sightings to a person's decision, the map and the service.
#include <gtest/gtest.h>

#include <algorithm>

#include "programs/godwit-drill/flight_simulation/flight_judge.hpp"
#include "programs/godwit-drill/flight_simulation/flight_people.hpp"
#include "programs/godwit-drill/flight_simulation/scan_mission.hpp"
#include "tests/programs/godwitd/sighting_text.hpp"
#include "tests/support/run_options.hpp"

namespace scan_flight_test {

using namespace godwit;
using namespace godwit::drill;
using executor::phase;
using runtime::crash_point;
using scan_controller::decision;
using sim::missions::row_kind;

constexpr double part_holds_s = 6; // and a little more

class scan_flight : public testing::Test {
protected:
  explicit scan_flight(const flight_simulation::options& wanted = {.speed = 2, .is_shuffled = false})
      : flight(wanted, scan_mission(wanted.who)) {
    flight.outside().settings.scan.looks_for = {"vehicle"};
  }

  void take_off() {
    ASSERT_TRUE(flight.run_until_phase(phase::flying, 120)) << flight.story();
    flight.run_for(part_holds_s);
    ASSERT_TRUE(flight.process()->points()) << flight.story();
  }
  // A vehicle in the middle of the survey, so far to the north.
  void see(int number, double north_m, double confidence = 0.9) {
    flight.process()->see(seen_in_survey(flight, test::sighting_id(number), north_m, confidence));
    flight.run_for(1);
  }
  void land() {
    EXPECT_TRUE(flight.run_until_phase(phase::done, 600)) << flight.story();
    EXPECT_EQ(flaw_of_reports(flight), "") << flight.story();
  }
  std::vector<std::string> rows_of(row_kind kind) {
    std::vector<std::string> result;
    for (const auto& each : flight.service().rows(flight.mission_id(), kind))
      result.push_back(each.text);
    return result;
  }
  std::size_t gone() {
    return static_cast<std::size_t>(std::ranges::count_if(rows_of(row_kind::observation), [](const std::string& row) {
      return row.find("removed_candidate") != std::string::npos;
    }));
  }

  flight_simulation flight;
};

TEST_F(scan_flight, what_is_seen_is_shown_to_people_and_their_decision_reaches_the_map_and_the_service) {
  flight.outside().settings.scan.looks_for.clear(); // else what is not seen again may be gone
  take_off();
  see(1, 10);
  see(2, 60);
  EXPECT_TRUE(flight.was_told("point 1: vehicle, 90 %")) << flight.story();
  EXPECT_TRUE(flight.process()->decide({1, decision::confirm, "anna"}).is_taken);
  EXPECT_TRUE(flight.process()->decide({2, decision::decline, "anna"}).is_taken);
  flight.run_for(1);
  EXPECT_TRUE(flight.was_told("point 2 is declined by anna")) << flight.story();
  see(3, 60); // there again
  EXPECT_EQ(flight.process()->points()->counts.opened, 2U);
  land();
  EXPECT_EQ(rows_of(row_kind::ignored_item).size(), 1U) << flight.story();
  ASSERT_EQ(rows_of(row_kind::observation).size(), 3U) << flight.story();
  EXPECT_NE(rows_of(row_kind::observation)[2].find("ignored"), std::string::npos);
}

TEST_F(scan_flight, nobody_looks_for_points_before_the_flight_and_after_it) {
  ASSERT_TRUE(flight.run_until_phase(phase::ready, 120)) << flight.story();
  EXPECT_FALSE(flight.process()->points());
  EXPECT_FALSE(flight.process()->look_at("scan_controller").wanted);
  take_off();
  EXPECT_TRUE(flight.process()->look_at("scan_controller").wanted);
  land();
  flight.run_for(part_holds_s);
  EXPECT_FALSE(flight.process()->look_at("scan_controller").wanted);
  EXPECT_FALSE(flight.was_told("scan_controller is back"));
}

TEST_F(scan_flight, what_is_not_seen_in_a_whole_pass_over_its_place_may_be_gone) {
  take_off();
  see(1, 10); // on the way there
  see(2, 60);
  ASSERT_TRUE(flight.run_until([&] { return is_in_survey(flight); }, 120)) << flight.story();
  see(3, 60);
  land();
  EXPECT_EQ(gone(), 1U) << flight.story();
}

TEST_F(scan_flight, a_survey_that_is_held_on_the_way_says_of_nothing_that_it_is_gone) {
  take_off();
  see(1, 10);
  ASSERT_TRUE(flight.run_until([&] { return is_in_survey(flight); }, 120)) << flight.story();
  flight.run_for(15);
  flight.say(operators::command_kind::pause);
  ASSERT_TRUE(flight.run_until_phase(phase::paused, 20)) << flight.story();
  flight.run_for(5);
  flight.say(operators::command_kind::resume);
  land();
  EXPECT_EQ(gone(), 0U) << flight.story();
  EXPECT_TRUE(flight.was_told("a survey is no whole pass")) << flight.story();
}

TEST_F(scan_flight, a_process_killed_in_the_survey_says_of_nothing_that_it_is_gone_and_keeps_what_was_decided) {
  take_off();
  see(1, 10);
  see(2, 60);
  EXPECT_TRUE(flight.process()->decide({1, decision::decline, "anna"}).is_taken);
  ASSERT_TRUE(flight.run_until([&] { return is_in_survey(flight); }, 120)) << flight.story();
  flight.run_for(15);
  flight.kill_process();
  flight.run_for(part_holds_s);
  const auto points = flight.process()->points();
  ASSERT_TRUE(points) << flight.story();
  EXPECT_EQ(points->counts.declined, 1U);
  EXPECT_EQ(points->counts.opened, 2U) << "the file of sightings is read again, and they are the same";
  land();
  EXPECT_EQ(gone(), 0U) << flight.story();
  EXPECT_EQ(rows_of(row_kind::ignored_item).size(), 1U) << flight.story();
}

TEST_F(scan_flight, a_waypoint_is_flown_at_a_point_only_when_a_person_says_so_once_more) {
  take_off();
  see(1, 20);
  ASSERT_TRUE(flight.process()->decide({1, decision::confirm, "anna"}).is_taken);
  flight.run_for(5);
  EXPECT_EQ(flight.service().mission(flight.mission_id()).revision, 1) << "a decision alone moves nothing";
  const auto at = flight.process()->points()->confirmed.at(0).position;
  operators::command insert;
  insert.kind = operators::command_kind::insert;
  insert.place = {at.latitude_deg, at.longitude_deg, 20};
  flight.say(insert);
  flight.run_for(5);
  EXPECT_EQ(flight.service().mission(flight.mission_id()).revision, 2) << flight.story();
  land();
  EXPECT_TRUE(flight.track().was_near(*insert.place, 5, flight.now_ns())) << flight.story();
}

TEST_F(scan_flight, given_up_it_touches_neither_the_flight_nor_what_goes_into_the_map) {
  take_off();
  ASSERT_TRUE(flight.give_up("scan_controller")) << flight.story();
  EXPECT_EQ(flight.processes(), 1);
  see(1, 10);
  land();
  EXPECT_EQ(flight.processes(), 1);
  EXPECT_EQ(rows_of(row_kind::observation).size(), 1U) << flight.story();
}

class scan_crash : public testing::TestWithParam<crash_point> {};

TEST_P(scan_crash, in_a_flight_shows_each_point_once_loses_no_decision_and_leaves_the_flight_alone) {
  const std::uint64_t seeds = tests::is_full_run() ? 20 : 1;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    flight_simulation flight({.seed = seed, .speed = 2, .is_recorded = true}, scan_mission(sim::personality::px4));
    ASSERT_TRUE(flight.run_until_phase(phase::flying, 120)) << flight.story();
    flight.run_for(part_holds_s);
    for (int number = 1; number <= 4; ++number) {
      flight.process()->crash_at("scan_controller", GetParam());
      flight.process()->see(seen_in_survey(flight, test::sighting_id(number), 40.0 * number, 0.9));
      flight.run_for(13); // five in a minute, and it would be given up
    }
    flight.process()->crash_at("scan_controller", GetParam());
    const auto says = scan_controller::decide_point{4, decision::decline, "anna"};
    if (!flight.process()->decide(says).is_taken) { // whoever hears that the outcome is unknown says it again
      flight.run_for(1);
      EXPECT_TRUE(flight.process()->decide(says).is_taken) << flight.story();
    }
    EXPECT_GE(flight.process()->crashes("scan_controller"), 4U);
    const auto points = flight.process()->points();
    ASSERT_TRUE(points) << flight.story();
    EXPECT_EQ(points->counts.opened, 4U) << flight.story();
    EXPECT_TRUE(flight.run_until_phase(phase::done, 600)) << flight.story();
    EXPECT_EQ(flaw_of_reports(flight), "") << flight.story();
    EXPECT_EQ(flight.service().rows(flight.mission_id(), row_kind::ignored_item).size(), 1U) << flight.story();
    EXPECT_TRUE(flight.record().broken().empty()) << flight.record().broken().front();
  }
}

INSTANTIATE_TEST_SUITE_P(each_point, scan_crash,
                         testing::Values(crash_point::before_handler, crash_point::after_handler,
                                         crash_point::after_commit, crash_point::before_dispatch),
                         [](const auto& each) { return "point_" + std::to_string(static_cast<int>(each.param)); });

} // namespace scan_flight_test
