// The eyes in whole flights, with a helper process that has all vices: what it sees reaches people and the map, and
// nothing that it does touches the flight.
#include <gtest/gtest.h>

#include <algorithm>

#include "actors/domain/geo/geodesic.hpp"
#include "programs/godwit-drill/flight_simulation/flight_judge.hpp"
#include "programs/godwit-drill/flight_simulation/scan_mission.hpp"
#include "tests/programs/godwitd/scratch.hpp"

namespace eyes_flight_test {

using namespace godwit;
using namespace godwit::drill;
using executor::phase;
using scan_controller::decision;
using sim::missions::row_kind;

class eyes_flight : public testing::Test {
protected:
  eyes_flight() : flight({.speed = 2, .is_shuffled = false}, mission_with_pictures()) {
    movement_detector::settings camera;
    camera.uri = "test://ball";
    camera.width_px = 640;
    camera.height_px = 360;
    camera.focal_px = 500;
    auto& settings = flight.outside().settings;
    settings.camera = camera;
    settings.scan.watches_view = true;
    settings.scan.looks_for = {"vehicle"};
  }

  // Of a service that takes pictures.
  static mission::document mission_with_pictures() {
    auto result = scan_mission(sim::personality::px4);
    result.schema_version = "2.2.0";
    return result;
  }
  void add_mover(std::uint32_t track, double north_m) {
    const auto at = seen_in_survey(flight, "", north_m, 1).position;
    flight.outside().eyes.movers.push_back({track, at.latitude_deg, at.longitude_deg});
  }
  void fly_to_survey() {
    ASSERT_TRUE(flight.run_until_phase(phase::flying, 120)) << flight.story();
    ASSERT_TRUE(flight.run_until([&] { return is_in_survey(flight); }, 120)) << flight.story();
  }
  void land() {
    EXPECT_TRUE(flight.run_until_phase(phase::done, 900)) << flight.story();
    EXPECT_EQ(flaw_of_reports(flight), "") << flight.story();
  }
  bool was_pass_lost() { return flight.was_told("the camera has not seen all of it"); }
  std::size_t rows(row_kind kind, const std::string& words) {
    const auto all = flight.service().rows(flight.mission_id(), kind);
    return static_cast<std::size_t>(
        std::ranges::count_if(all, [&](const auto& each) { return each.text.find(words) != std::string::npos; }));
  }

  flight_simulation flight;
};

TEST_F(eyes_flight, what_moves_is_shown_to_people_and_their_decisions_reach_the_map_and_the_service) {
  add_mover(1, 30);
  add_mover(2, 200);
  fly_to_survey();
  ASSERT_TRUE(flight.run_until([&] { return flight.process()->points()->counts.opened == 2; }, 300)) << flight.story();
  EXPECT_TRUE(flight.process()->decide({1, decision::confirm, "anna"}).is_taken);
  flight.run_for(1);
  EXPECT_TRUE(flight.process()->decide({2, decision::decline, "anna"}).is_taken);
  land();
  EXPECT_FALSE(was_pass_lost()) << flight.story();
  EXPECT_EQ(rows(row_kind::ignored_item, ""), 1U);
  EXPECT_GE(rows(row_kind::observation, "moving"), 2U);
  EXPECT_EQ(flight.outside().eyes.starts, 1);
}

TEST_F(eyes_flight, the_picture_of_each_point_reaches_the_service_once_over_a_kill_and_a_service_that_fails) {
  const test::scratch folder;
  flight.outside().settings.pictures_folder = folder.file("pictures");
  flight.kill_process(); // the next one has the folder
  add_mover(1, 30);
  add_mover(2, 200);
  fly_to_survey();
  ASSERT_TRUE(flight.run_until([&] { return flight.process()->points()->counts.opened == 1; }, 300)) << flight.story();
  flight.run_for(1);
  flight.kill_process();
  ASSERT_TRUE(flight.run_until([&] { return flight.process() && flight.process()->points()->counts.opened == 2; }, 300))
      << flight.story();
  flight.run_for(5);
  EXPECT_EQ(rows(row_kind::picture, ""), 0U) << "in flight reports and the map come first";
  flight.service().set_fault("lose on post-picture times 2");
  land();
  ASSERT_TRUE(flight.run_until([&] { return rows(row_kind::picture, "") == 2; }, 120)) << flight.story();
  EXPECT_EQ(flight.service().figures(row_kind::picture).repeated, 0U);
  const auto observations = flight.service().rows(flight.mission_id(), row_kind::observation);
  for (const auto& picture : flight.service().rows(flight.mission_id(), row_kind::picture))
    EXPECT_EQ(std::ranges::count(observations, picture.id, &sim::missions::stored_row::id), 1) << picture.text;
}

TEST_F(eyes_flight, they_are_open_only_while_a_mission_with_scanning_is_flown) {
  ASSERT_TRUE(flight.run_until_phase(phase::ready, 120)) << flight.story();
  EXPECT_EQ(flight.outside().eyes.starts, 0);
  EXPECT_FALSE(flight.process()->view_of_eyes());
  fly_to_survey();
  ASSERT_TRUE(flight.process()->view_of_eyes());
  EXPECT_TRUE(flight.process()->view_of_eyes()->is_seeing) << flight.process()->view_of_eyes()->sentence;
  land();
  flight.run_for(10);
  EXPECT_FALSE(flight.process()->view_of_eyes());
  EXPECT_EQ(flight.process()->eyes().next_deadline_ns(), simulated_eyes::never_ns) << "the helper was ended";
}

TEST_F(eyes_flight, a_helper_that_is_killed_comes_back_and_the_pass_is_no_whole_one_if_too_much_was_missed) {
  fly_to_survey();
  flight.run_for(5);
  flight.process()->eyes().kill();
  flight.run_for(5);
  EXPECT_EQ(flight.outside().eyes.starts, 2);
  EXPECT_TRUE(flight.process()->view_of_eyes()->is_seeing);
  flight.process()->eyes().talk_garbage();
  flight.run_for(5);
  EXPECT_EQ(flight.outside().eyes.starts, 3);
  EXPECT_TRUE(flight.was_told("godwit-eyes is started again")) << flight.story();
  land();
}

TEST_F(eyes_flight, a_camera_that_is_gone_on_the_way_is_named_and_nothing_is_said_to_be_gone_from_the_map) {
  fly_to_survey();
  flight.run_for(5);
  flight.outside().eyes.has_no_camera = true;
  flight.run_for(10);
  EXPECT_EQ(flight.process()->health("movement_detector"), runtime::health_colour::yellow);
  flight.outside().eyes.has_no_camera = false;
  flight.run_for(3);
  EXPECT_EQ(flight.process()->health("movement_detector"), runtime::health_colour::green);
  land();
  EXPECT_TRUE(was_pass_lost()) << flight.story();
}

TEST_F(eyes_flight, black_pictures_all_the_way_are_no_pass) {
  flight.outside().eyes.shows_black = true;
  fly_to_survey();
  flight.run_for(5);
  EXPECT_EQ(flight.process()->health("movement_detector"), runtime::health_colour::yellow);
  land();
  EXPECT_TRUE(was_pass_lost()) << flight.story();
}

TEST_F(eyes_flight, eyes_that_hang_are_started_again_and_again_and_the_flight_goes_on) {
  fly_to_survey();
  flight.outside().eyes.hangs = true;
  land();
  EXPECT_GT(flight.outside().eyes.starts, 3);
  EXPECT_TRUE(was_pass_lost()) << flight.story();
}

TEST_F(eyes_flight, an_actor_that_is_given_up_takes_nothing_with_it) {
  fly_to_survey();
  ASSERT_TRUE(flight.give_up("movement_detector"));
  land();
  EXPECT_TRUE(was_pass_lost()) << flight.story();
}

TEST_F(eyes_flight, a_process_killed_in_the_survey_opens_its_eyes_again) {
  fly_to_survey();
  flight.run_for(5);
  flight.kill_process();
  flight.run_for(12);
  ASSERT_TRUE(flight.process()->view_of_eyes()) << flight.story();
  EXPECT_TRUE(flight.process()->view_of_eyes()->is_seeing) << flight.process()->view_of_eyes()->sentence;
  land();
}

} // namespace eyes_flight_test
