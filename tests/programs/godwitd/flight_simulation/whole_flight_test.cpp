// A whole mission of the missions service on the real composition of the daemon, while nobody crashes.
#include <gtest/gtest.h>

#include "actors/domain/geo/geodesic.hpp"
#include "programs/godwit-drill/flight_simulation/flight_judge.hpp"
#include "programs/godwit-drill/flight_simulation/flight_people.hpp"
#include "programs/godwit-drill/flight_simulation/short_mission.hpp"
#include "tests/programs/godwitd/sighting_text.hpp"

namespace whole_flight_test {

using namespace godwit;
using namespace godwit::drill;
using executor::phase;
using mission::progress_kind;
using sim::missions::row_kind;

class whole_flight : public testing::TestWithParam<sim::personality> {
protected:
  flight_simulation flight{{.who = GetParam()}};

  void expect_sound_end() {
    EXPECT_TRUE(executor::is_at_rest(flight.status().now)) << flight.story();
    EXPECT_EQ(flaw_of_reports(flight), "") << flight.story();
  }
  // On its way to an item in the middle.
  void fly_past(const std::string& item) {
    const auto has_been_there = [&] {
      for (const auto& each : flight.reports())
        if (each.kind == progress_kind::reached && each.item_id == item)
          return true;
      return false;
    };
    ASSERT_TRUE(flight.run_until(has_been_there, 120)) << flight.story();
  }
};

mission::position place_at(const std::string& waypoint) {
  const auto items = short_mission(sim::personality::px4).items;
  for (const auto& each : items)
    if (mission::id_of(each) == waypoint)
      return std::get<mission::waypoint>(each).at;
  return {};
}

TEST_P(whole_flight, a_mission_is_fetched_uploaded_flown_and_told_once_and_in_order) {
  EXPECT_TRUE(flight.run_until_phase(phase::done, 300)) << flight.story();
  expect_sound_end();
  const auto reports = flight.reports();
  EXPECT_EQ(reports.front().kind, progress_kind::started);
  EXPECT_FALSE(flight.vehicle().describe().in_air) << flight.story();
}

TEST_P(whole_flight, what_was_seen_on_the_way_is_delivered_once_after_the_flight) {
  ASSERT_TRUE(flight.run_until_phase(phase::flying, 120)) << flight.story();
  mapobjects_store::sighting seen;
  seen.id = test::sighting_id(1);
  seen.mission_id = flight.mission_id();
  seen.class_group = "vehicle";
  seen.position = {47.3981, 8.5461, {}};
  seen.at_ns = flight.wall_ns();
  seen.confidence = 0.9;
  flight.process()->see(seen);
  EXPECT_TRUE(flight.run_until_phase(phase::done, 300)) << flight.story();
  const auto rows = flight.service().rows(flight.mission_id(), row_kind::observation);
  ASSERT_EQ(rows.size(), 1U) << flight.story();
  EXPECT_EQ(rows.front().id, seen.id);
  EXPECT_EQ(rows.front().deliveries, 1U);
}

TEST_P(whole_flight, an_assignment_on_the_way_is_flown_and_answered_once) {
  fly_past("w1");
  sim::missions::assignment_request wanted;
  wanted.replace_after_item_id = "w2";
  wanted.items = {place(GetParam(), "n1", 20, 20), place(GetParam(), "n2", -30, 20)};
  if (GetParam() != sim::personality::rover)
    wanted.items.push_back(way_home(GetParam(), "home_again"));
  ASSERT_TRUE(flight.service().assign(flight.mission_id(), wanted, flight.now_ns()));
  EXPECT_TRUE(flight.run_until_phase(phase::done, 300)) << flight.story();
  expect_sound_end();
  EXPECT_EQ(flight.service().rows(flight.mission_id(), row_kind::response).size(), 1U) << flight.story();
  EXPECT_EQ(flight.service().mission(flight.mission_id()).revision, 2) << flight.story();
}

TEST_P(whole_flight, a_pilot_who_takes_the_vehicle_on_the_way_is_left_alone_until_it_is_handed_back) {
  fly_past("w1");
  flight.switch_mode(pilot_mode(GetParam()));
  ASSERT_TRUE(flight.run_until_phase(phase::paused, 5)) << flight.story();
  EXPECT_EQ(flight.status().cause, executor::pause_cause::taken_over) << flight.story();
  const auto since_ns = flight.now_ns();
  flight.run_for(20);
  EXPECT_EQ(moves_since(flight, since_ns), 0) << flight.story();
  EXPECT_TRUE(fly_with_help(flight)) << flight.story();
  expect_sound_end();
}

TEST_P(whole_flight, a_map_that_can_not_be_pulled_keeps_it_on_the_ground_and_the_reason_is_said) {
  flight.service().set_fault("status 503 on get-mapobjects");
  flight.run_for(60);
  EXPECT_FALSE(flight.status().in_flight) << flight.story();
  EXPECT_FALSE(flight.vehicle().describe().armed) << flight.story();
  EXPECT_TRUE(flight.reports().empty());
  EXPECT_NE(flight.story().find("map could not be pulled"), std::string::npos) << flight.story();
}

TEST_P(whole_flight, a_pull_that_is_late_delays_the_flight_and_does_not_end_it) {
  flight.service().set_fault("status 503 on get-mapobjects times 2");
  EXPECT_TRUE(flight.run_until_phase(phase::done, 300)) << flight.story();
  expect_sound_end();
}

TEST_P(whole_flight, a_map_whose_pull_failed_is_pulled_again_by_itself_and_the_mission_is_flown) {
  flight.service().set_fault("status 503 on get-mapobjects times 5");
  flight.run_for(30);
  ASSERT_NE(flight.story().find("map could not be pulled"), std::string::npos) << flight.story();
  EXPECT_TRUE(flight.run_until_phase(phase::done, 300)) << flight.story();
  expect_sound_end();
}

TEST_P(whole_flight, a_map_whose_pull_failed_is_pulled_at_once_when_an_operator_says_so) {
  flight.service().set_fault("status 503 on get-mapobjects times 5");
  flight.run_for(30);
  ASSERT_NE(flight.story().find("map could not be pulled"), std::string::npos) << flight.story();
  flight.say(operators::command_kind::pull);
  EXPECT_TRUE(flight.run_until_phase(phase::flying, 15)) << flight.story();
}

TEST_P(whole_flight, a_mission_that_was_refused_is_asked_for_again_after_a_minute) {
  flight.service().set_fault("status 503 on get-mission times 5");
  flight.run_for(40);
  EXPECT_FALSE(flight.status().in_flight) << flight.story();
  EXPECT_TRUE(flight.run_until_phase(phase::done, 400)) << flight.story();
  expect_sound_end();
}

TEST_P(whole_flight, with_the_service_down_from_take_off_to_landing_it_is_flown_to_its_end_and_told_afterwards) {
  ASSERT_TRUE(flight.run_until_phase(phase::flying, 120)) << flight.story();
  flight.service().set_fault("drop");
  EXPECT_TRUE(flight.run_until_phase(phase::post_flight, 300)) << flight.story();
  EXPECT_FALSE(flight.vehicle().describe().in_air) << flight.story();
  flight.run_for(120);
  EXPECT_EQ(flight.status().now, phase::post_flight) << "what is owed is not delivered\n" << flight.story();
  flight.service().clear_faults();
  EXPECT_TRUE(flight.run_until_phase(phase::done, 400)) << flight.story();
  expect_sound_end();
}

TEST_P(whole_flight, a_disk_without_room_keeps_it_on_the_ground) {
  flight.outside().free_disk_bytes = 1;
  flight.run_for(60);
  EXPECT_FALSE(flight.vehicle().describe().armed) << flight.story();
  EXPECT_NE(flight.story().find("are free on the disk"), std::string::npos) << flight.story();
}

TEST_P(whole_flight, begins_by_the_start_of_a_ground_station_and_not_before) {
  flight_simulation waits({.who = GetParam(), .starts_by_itself = false});
  ASSERT_TRUE(waits.run_until_phase(phase::ready, 120)) << waits.story();
  waits.run_for(20);
  EXPECT_FALSE(waits.vehicle().describe().armed) << waits.story();
  waits.station().start_mission();
  EXPECT_TRUE(waits.run_until_phase(phase::done, 300)) << waits.story();
  ASSERT_TRUE(waits.station().start_answer());
  EXPECT_EQ(waits.station().start_answer()->result, 0) << "accepted";
  EXPECT_EQ(flaw_of_reports(waits), "") << waits.story();
}

INSTANTIATE_TEST_SUITE_P(every_vehicle, whole_flight,
                         testing::Values(sim::personality::rover, sim::personality::px4, sim::personality::ardupilot,
                                         sim::personality::plane),
                         [](const auto& who) { return std::string(io::name_of(who.param)); });

// What makes a failure of a random flight worth anything.
// Of a rover, that it is armed says nothing: it stands.
TEST(rover_left_armed, by_a_start_that_was_cut_off_is_prepared_again_whenever_godwit_is_killed) {
  for (const auto killed_in : {phase::uploading, phase::ready}) {
    flight_simulation::options wanted{.who = sim::personality::rover};
    wanted.line.in.delay = wanted.line.out.delay = std::chrono::milliseconds(50); // else an upload takes no time
    flight_simulation flight(wanted);
    ASSERT_TRUE(flight.run_until([&] { return flight.vehicle().describe().armed; }, 60)) << flight.story();
    flight.kill_process();
    ASSERT_TRUE(flight.run_until_phase(phase::paused, 20)) << flight.story();
    EXPECT_EQ(flight.status().cause, executor::pause_cause::restarted) << flight.story();
    flight.say(operators::command_kind::resume);
    ASSERT_TRUE(flight.run_until_phase(killed_in, 20)) << flight.story();
    flight.kill_process();
    EXPECT_TRUE(fly_with_help(flight)) << flight.story();
    EXPECT_EQ(flaw_of_reports(flight), "") << flight.story();
  }
}

// PX4 says of any landing that its plan is complete. At home, and after a hand-back, it may be so.
TEST(landed_at_home_by_a_pilot, a_mission_is_complete_or_flown_on_and_never_both) {
  for (int tenths = 0; tenths <= 15; ++tenths) {
    flight_simulation flight({.who = sim::personality::px4});
    const auto is_over_home = [&] {
      const auto seen = flight.vehicle().describe().where;
      const auto home = flight.first_mission().return_point.value();
      return flight.track().was_near(place_at("w3"), 10, flight.now_ns()) &&
             geo::distance_m(geo::point{seen.latitude_deg, seen.longitude_deg},
                             geo::point{home.latitude, home.longitude}) < 5;
    };
    ASSERT_TRUE(flight.run_until(is_over_home, 120)) << flight.story();
    flight.switch_mode(landing_mode(sim::personality::px4));
    ASSERT_TRUE(flight.run_until([&] { return !flight.vehicle().describe().armed; }, 60)) << flight.story();
    flight.run_for(5);
    flight.say(operators::command_kind::hand_back);
    flight.run_for(0.1 * tenths);
    flight.say(operators::command_kind::resume);
    EXPECT_TRUE(fly_with_help(flight)) << flight.story();
    EXPECT_EQ(flaw_of_reports(flight), "") << "resumed " << tenths << " tenths of a second later\n" << flight.story();
  }
}

TEST(flight_simulation, the_same_seed_flies_the_same_flight) {
  const auto story_of = [](std::uint64_t seed) {
    flight_simulation flight({.seed = seed});
    flight.kill_process_at_commit(20, flight_simulation::side::before);
    flight.run_for(20);
    flight.process()->crash_at("executor", runtime::crash_point::after_handler);
    (void)fly_with_help(flight);
    return flight.story();
  };
  EXPECT_EQ(story_of(7), story_of(7));
  EXPECT_NE(story_of(7), story_of(8));
}

} // namespace whole_flight_test
