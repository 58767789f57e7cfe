// What became of an act, and the pictures of a line.
#include "actors/executor/progress/acts.hpp"

#include <cstdint>
#include <string>

#include <gtest/gtest.h>

#include "tests/actors/executor/progress/progress_fixture.hpp"

namespace godwit::executor::progress {
namespace acts_test {

using namespace test;
using mission::act_outcome;

struct acts : testing::Test {
  progress_fixture d{ardupilot};

  // The item at POSITION acts, and moves nothing.
  static void make_act(plan_map& map, std::size_t position, act_kind what) {
    auto& item = map.items[position];
    item.role = item_role::acts;
    item.act = what;
    item.first_nav_sequence = item.last_nav_sequence = std::nullopt;
  }

  void fly(const plan_map& map) {
    d.upload(map);
    d.current(0);
    d.wait_s(3);
    d.current(0);
    d.said();
    d.news_told();
  }

  // A, the act, C.
  void fly_with(const std::string& id, act_kind what) {
    auto map = map_of(d.vehicle, {"A", id, "C"});
    make_act(map, 1, what);
    fly(map);
  }

  void fly_to_release() {
    fly_with("drop", act_kind::release);
    d.reached(0);
    EXPECT_EQ(d.said(), texts{"reached A#0 g1"});
    d.current(2);
  }
};

TEST_F(acts, a_release_that_the_gripper_reports_is_confirmed) {
  fly_to_release();
  EXPECT_EQ(d.said(), texts{}) << "the gripper may still report it";
  d.wait_ms(500);
  d.take(*act_in("Gripper load released"));
  EXPECT_EQ(d.said(), (texts{"passed drop#1 g1 confirmed", "started C#2 g1"}));
}

TEST_F(acts, a_release_that_nobody_reports_is_passed_and_no_more) {
  fly_to_release();
  d.wait_s(1);
  d.current(2);
  EXPECT_EQ(d.said(), texts{});
  d.wait_s(1);
  d.current(2);
  EXPECT_EQ(d.said(), (texts{"passed drop#1 g1 inferred", "started C#2 g1"}));
}

TEST_F(acts, the_answer_of_the_command_confirms_no_release) {
  EXPECT_FALSE(act_in("Gripper Released"));
  EXPECT_FALSE(act_in("Gripper load releasing"));
}

TEST_F(acts, a_release_survives_a_crash_before_it_is_reported) {
  fly_to_release();
  d.crash();
  d.take(*act_in("Gripper load released"));
  EXPECT_EQ(d.said(), (texts{"passed drop#1 g1 confirmed", "started C#2 g1"}));
}

struct held_back : acts {
  // A, a condition, the release, C.
  void fly_on(std::uint32_t late_s) {
    auto map = map_of(d.vehicle, {"A", "when", "drop", "C"});
    make_act(map, 1, act_kind::none);
    make_act(map, 2, act_kind::release);
    map.items[2].act_late_s = late_s;
    fly(map);
    d.reached(0);
    d.current(3);
    d.said();
  }
};

TEST_F(held_back, a_release_after_a_condition_is_confirmed_when_it_comes) {
  fly_on(20);
  for (int i = 0; i < 15; ++i) {
    d.wait_s(1);
    d.current(3);
  }
  EXPECT_EQ(d.said(), texts{});
  d.take(*act_in("Gripper load released"));
  EXPECT_EQ(d.said(), (texts{"passed when#1 g1 inferred", "passed drop#2 g1 confirmed", "started C#3 g1"}));
}

TEST_F(held_back, a_release_after_a_delay_is_not_awaited_longer_than_that) {
  fly_on(20);
  d.wait_s(21);
  d.current(3);
  EXPECT_EQ(d.said(), texts{});
  d.wait_s(1);
  d.current(3);
  EXPECT_EQ(d.said(), (texts{"passed when#1 g1 inferred", "passed drop#2 g1 inferred", "started C#3 g1"}));
}

TEST_F(held_back, a_release_whose_condition_never_came_true_is_passed_at_the_next_place) {
  fly_on(86'400);
  d.wait_s(600);
  d.current(3);
  d.reached(3);
  EXPECT_EQ(d.said(),
            (texts{"passed when#1 g1 inferred", "passed drop#2 g1 inferred", "reached C#3 g1", "complete g1"}));
  d.take(*act_in("Gripper load released"));
  EXPECT_EQ(d.said(), texts{});
}

TEST_F(held_back, a_release_after_a_condition_is_awaited_over_a_crash) {
  fly_on(20);
  d.crash();
  d.wait_s(10);
  d.take(*act_in("Gripper load released"));
  EXPECT_EQ(d.said(), (texts{"passed when#1 g1 inferred", "passed drop#2 g1 confirmed", "started C#3 g1"}));
}

struct last_act : acts {
  void fly_to_last_release() {
    auto map = map_of(d.vehicle, {"A", "drop"});
    make_act(map, 1, act_kind::release);
    fly(map);
    d.reached(0);
    EXPECT_EQ(d.said(), texts{"reached A#0 g1"});
  }
};

TEST_F(last_act, a_release_after_the_last_movement_is_confirmed_and_ends_the_plan) {
  fly_to_last_release();
  EXPECT_EQ(d.news_told(), texts{}) << "the gripper may still report it";
  d.wait_ms(500);
  d.take(*act_in("Gripper load released"));
  EXPECT_EQ(d.said(), (texts{"passed drop#1 g1 confirmed", "complete g1"}));
  EXPECT_EQ(d.news_told(), (texts{"plan_done g1", "mission_complete g1"}));
}

TEST_F(last_act, a_release_after_the_last_movement_that_nobody_reports_is_passed_and_ends_the_plan) {
  fly_to_last_release();
  d.wait_s(1);
  d.current(0);
  EXPECT_EQ(d.said(), texts{});
  d.wait_s(1);
  d.current(0);
  EXPECT_EQ(d.said(), (texts{"passed drop#1 g1 inferred", "complete g1"}));
}

// A PX4 reports the item as reached before its camera reports the picture.
TEST_F(last_act, a_last_picture_that_comes_after_its_item_is_reached_is_confirmed) {
  auto map = map_of(d.vehicle, {"A", "photo"});
  make_act(map, 1, act_kind::picture);
  fly(map);
  d.reached(0);
  d.current(1);
  d.reached(1);
  EXPECT_EQ(d.said(), texts{"reached A#0 g1"});
  d.take(picture_told{4});
  EXPECT_EQ(d.said(), (texts{"passed photo#1 g1 confirmed pictures 1: 4 to 4", "complete g1"}));
}

TEST_F(last_act, a_release_after_the_last_movement_survives_a_crash) {
  fly_to_last_release();
  d.crash();
  d.take(*act_in("Gripper load released"));
  EXPECT_EQ(d.said(), (texts{"passed drop#1 g1 confirmed", "complete g1"}));
}

// Somebody else may have opened the gripper on the way.
TEST_F(acts, a_release_before_the_vehicle_is_there_confirms_nothing) {
  fly_with("drop", act_kind::release);
  d.take(*act_in("Gripper load released"));
  d.reached(0);
  d.current(2);
  d.wait_s(2);
  d.current(2);
  EXPECT_EQ(d.said(), (texts{"reached A#0 g1", "passed drop#1 g1 inferred", "started C#2 g1"}));
}

TEST_F(acts, a_text_counts_for_one_act_alone) {
  auto map = map_of(d.vehicle, {"A", "drop", "grab", "again", "C"});
  make_act(map, 1, act_kind::release);
  make_act(map, 2, act_kind::grab);
  make_act(map, 3, act_kind::release);
  fly(map);
  d.reached(0);
  d.current(4);
  d.take(*act_in("Gripper load released"));
  d.take(*act_in("Gripper load grabbed"));
  EXPECT_EQ(d.said(), texts{"reached A#0 g1"});
  d.wait_s(2);
  d.current(4);
  EXPECT_EQ(d.said(), (texts{"passed drop#1 g1 confirmed", "passed grab#2 g1 confirmed", "passed again#3 g1 inferred",
                             "started C#4 g1"}));
}

// ArduCopter reports the item as reached, and flies on with the load.
TEST_F(acts, a_load_that_is_still_on_board_is_no_delivery) {
  auto map = map_of(d.vehicle, {"A", "place", "C"});
  map.items[1].act = act_kind::placement;
  fly(map);
  d.reached(0);
  d.current(1);
  d.take(*act_in("PayloadPlace: Reached maximum descent"));
  EXPECT_EQ(d.news_told(), texts{"act_failed g1"});
  EXPECT_NE(d.told.back().reason.find("'place'"), std::string::npos);
  d.reached(1);
  d.current(2);
  EXPECT_EQ(d.said(), (texts{"reached A#0 g1", "started place#1 g1", "reached place#1 g1 failed", "started C#2 g1"}));
}

TEST_F(acts, a_load_that_the_gripper_has_released_on_the_ground_is_placed) {
  auto map = map_of(d.vehicle, {"A", "place", "C"});
  map.items[1].act = act_kind::placement;
  fly(map);
  d.reached(0);
  d.current(1);
  d.take(*act_in("Gripper load released"));
  d.reached(1);
  EXPECT_EQ(d.said(), (texts{"reached A#0 g1", "started place#1 g1", "reached place#1 g1 confirmed"}));
}

// As an ArduCopter: the picture comes just before REACHED.
TEST_F(acts, a_picture_just_before_reached_is_that_of_the_place) {
  fly_with("photo", act_kind::picture);
  d.take(picture_told{7});
  d.reached(0);
  d.current(2);
  EXPECT_EQ(d.said(), (texts{"reached A#0 g1", "passed photo#1 g1 confirmed pictures 1: 7 to 7", "started C#2 g1"}));
}

TEST_F(acts, a_picture_may_have_any_number) {
  fly_with("photo", act_kind::picture);
  d.take(picture_told{INT32_MAX});
  d.take(picture_told{INT32_MIN});
  d.reached(0);
  EXPECT_EQ(d.said(), texts{"reached A#0 g1 pictures 1: 2147483647 to 2147483647"});
  d.current(2);
  EXPECT_EQ(d.said(), (texts{"passed photo#1 g1 confirmed pictures 1: -2147483648 to -2147483648", "started C#2 g1"}));
}

TEST_F(acts, a_picture_that_was_not_taken_has_failed) {
  fly_with("photo", act_kind::picture);
  d.reached(0);
  d.current(2);
  d.take(picture_told{7, false});
  EXPECT_EQ(d.news_told(), texts{"act_failed g1"});
  EXPECT_EQ(d.said(), (texts{"reached A#0 g1", "passed photo#1 g1 failed pictures 0: 7 to 7", "started C#2 g1"}));
}

struct lines : acts {
  // A, a line to B, C. The first picture comes before the vehicle reports that it has reached A.
  void fly_to_line(std::uint32_t planned, bool ends_with_picture = false) {
    auto map = map_of(d.vehicle, {"A", "B", "C"});
    map.items[1].pictures = planned;
    map.items[1].lines = 1;
    map.items[1].ends_with_picture = ends_with_picture;
    fly(map);
    d.take(picture_told{1});
    d.reached(0);
    EXPECT_EQ(d.said(), texts{"reached A#0 g1"}) << "the picture is that of the line";
    d.current(1);
    d.said();
  }

  // All but the last one are reported.
  void fly_to_last_picture() {
    fly_to_line(3, true);
    d.take(picture_told{2});
    d.reached(1);
    d.wait_ms(300);
    d.current(2);
    EXPECT_EQ(d.said(), texts{}) << "the camera may still report it";
  }
};

TEST_F(lines, the_pictures_of_a_line_are_counted_from_its_beginning) {
  fly_to_line(7);
  for (int i = 2; i <= 7; ++i)
    d.take(picture_told{i});
  d.reached(1);
  EXPECT_EQ(d.said(), texts{"reached B#1 g1 pictures 7 of 7: 1 to 7"});
  EXPECT_EQ(d.news_told(), texts{});
}

// As a PX4: nothing comes of a place after which commands stand but that the vehicle goes on.
TEST_F(lines, the_first_picture_counts_where_the_vehicle_has_gone_on_to) {
  d = progress_fixture(px4);
  auto map = map_of(d.vehicle, {"A", "B", "C"});
  map.items[1].pictures = 2;
  fly(map);
  d.current(1);
  d.take(picture_told{4});
  d.wait_s(1);
  d.current(1);
  EXPECT_EQ(d.said(), (texts{"reached A#0 g1 inferred", "started B#1 g1"}));
  d.take(picture_told{5});
  d.reached(1);
  EXPECT_EQ(d.said(), texts{"reached B#1 g1 pictures 2 of 2: 4 to 5"});
}

TEST_F(lines, the_last_picture_counts_after_the_vehicle_has_gone_on_from_its_line) {
  fly_to_last_picture();
  d.take(picture_told{3});
  EXPECT_EQ(d.said(), (texts{"reached B#1 g1 pictures 3 of 3: 1 to 3", "started C#2 g1"}));
  d.take(picture_told{4});
  d.reached(2);
  EXPECT_EQ(d.said(), (texts{"reached C#2 g1 pictures 1: 4 to 4", "complete g1"}));
}

TEST_F(lines, the_last_picture_counts_where_it_comes_before_the_vehicle_goes_on) {
  fly_to_line(3, true);
  d.take(picture_told{2});
  d.reached(1);
  d.take(picture_told{3});
  EXPECT_EQ(d.said(), texts{"reached B#1 g1 pictures 3 of 3: 1 to 3"});
  d.current(2);
  EXPECT_EQ(d.said(), texts{"started C#2 g1"});
}

TEST_F(lines, the_last_picture_counts_over_a_crash) {
  fly_to_last_picture();
  d.crash();
  d.take(picture_told{3});
  EXPECT_EQ(d.said(), (texts{"reached B#1 g1 pictures 3 of 3: 1 to 3", "started C#2 g1"}));
}

TEST_F(lines, a_last_picture_that_does_not_come_is_awaited_for_two_seconds) {
  fly_to_last_picture();
  d.wait_ms(1'600);
  d.current(2);
  EXPECT_EQ(d.said(), texts{});
  d.wait_ms(100);
  d.current(2);
  EXPECT_EQ(d.said(), (texts{"reached B#1 g1 pictures 2 of 3: 1 to 2", "started C#2 g1"})) << "it was reported reached";
  EXPECT_EQ(d.news_told(), texts{}) << "one less is none missing";
}

TEST_F(lines, a_vehicle_that_stays_at_the_end_of_its_line_has_reached_it) {
  fly_to_line(3, true);
  d.take(picture_told{2});
  d.reached(1);
  d.wait_s(2);
  d.current(1);
  EXPECT_EQ(d.said(), texts{"reached B#1 g1 pictures 2 of 3: 1 to 2"});
}

TEST_F(lines, a_plan_that_ends_with_a_line_waits_for_its_last_picture) {
  auto map = map_of(d.vehicle, {"A", "B"});
  map.items[1].pictures = 2;
  map.items[1].ends_with_picture = true;
  fly(map);
  d.reached(0);
  d.current(1);
  d.take(picture_told{1});
  d.reached(1);
  d.current(1, mission_state::complete);
  EXPECT_EQ(d.said(), (texts{"reached A#0 g1", "started B#1 g1"}));
  d.take(picture_told{2});
  EXPECT_EQ(d.said(), (texts{"reached B#1 g1 pictures 2 of 2: 1 to 2", "complete g1"}));
}

TEST_F(lines, a_line_on_which_nobody_reports_pictures_waits_for_none) {
  auto map = map_of(d.vehicle, {"A", "B"});
  map.items[0].pictures = 2;
  map.items[0].ends_with_picture = true;
  fly(map);
  d.reached(0);
  EXPECT_EQ(d.said(), texts{"reached A#0 g1"});
}

// As an operator sends the vehicle away and back.
TEST_F(lines, a_rest_of_a_line_counts_on_where_the_line_was_left) {
  fly_to_line(7);
  for (int i = 2; i <= 4; ++i)
    d.take(picture_told{.index = i, .at = mission::vertex{47, 8.0 + i}});
  ASSERT_TRUE(d.s.mission->line);
  EXPECT_EQ(d.s.mission->line->item_id, "B");
  EXPECT_EQ(d.s.mission->line->at.longitude, 12);
  fly(map_of(d.vehicle, {"away"}, 1, false));
  d.take(picture_told{5});
  EXPECT_EQ(d.s.mission->line->pictures.taken, 4U) << "not of the line";
  d.crash();
  auto rest = map_of(d.vehicle, {"B", "C"}, 1);
  rest.items[0].pictures = 4 + 4;
  rest.items[0].continues_line = true;
  fly(rest);
  for (int i = 6; i <= 9; ++i)
    d.take(picture_told{i});
  d.reached(0);
  EXPECT_EQ(d.said(), (texts{"reached B#1 g3 pictures 8 of 8: 1 to 9"}));
  EXPECT_FALSE(d.s.mission->line) << "it is done";
}

TEST_F(lines, a_picture_that_is_reported_twice_counts_once) {
  fly_to_line(2);
  d.take(picture_told{2});
  d.take(picture_told{2});
  d.reached(1);
  EXPECT_EQ(d.said(), texts{"reached B#1 g1 pictures 2 of 2: 1 to 2"});
}

TEST_F(lines, pictures_of_a_silence_count_by_their_numbers) {
  fly_to_line(7);
  d.take(picture_told{2});
  d.crash();
  d.take(picture_told{7});
  d.reached(1);
  EXPECT_EQ(d.said(), texts{"reached B#1 g1 pictures 7 of 7: 1 to 7"});
}

TEST_F(lines, a_line_with_missing_pictures_is_reported) {
  fly_to_line(7);
  for (int i = 2; i <= 5; ++i)
    d.take(picture_told{i});
  d.reached(1);
  EXPECT_EQ(d.said(), texts{"reached B#1 g1 pictures 5 of 7: 1 to 5"});
  EXPECT_EQ(d.news_told(), texts{"pictures_missing g1"});
}

// The vehicle arrives some metres before the end of each.
TEST_F(lines, one_picture_less_on_each_line_of_a_survey_is_none_missing) {
  for (const int taken : {3, 2}) {
    d = progress_fixture(ardupilot);
    auto map = map_of(d.vehicle, {"A", "field", "C"});
    map.items[1].pictures = 6;
    map.items[1].lines = 3;
    fly(map);
    d.reached(0);
    d.current(1);
    for (int i = 1; i <= taken; ++i)
      d.take(picture_told{i});
    d.reached(1);
    EXPECT_EQ(d.news_told(), taken == 3 ? texts{} : texts{"pictures_missing g1"});
  }
}

TEST_F(lines, that_no_pictures_are_reported_at_all_is_told_once) {
  auto map = map_of(d.vehicle, {"A", "B", "C"});
  map.items[0].pictures = map.items[1].pictures = 5;
  fly(map);
  d.reached(0);
  d.current(1);
  d.reached(1);
  EXPECT_EQ(d.said(), (texts{"reached A#0 g1", "started B#1 g1", "reached B#1 g1"}));
  EXPECT_EQ(d.news_told(), texts{"pictures_missing g1"});
}

} // namespace acts_test
} // namespace godwit::executor::progress
