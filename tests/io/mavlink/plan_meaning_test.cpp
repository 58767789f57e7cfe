#include "io/mavlink/plan_meaning.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/transfer_world.hpp"

namespace godwit::io::mavlink {
namespace plan_meaning_test {

using io::mavlink::mav_frame;
using io::mavlink::number;
using tests::mission_of;

TEST(meaning, what_ardupilot_changes_in_storing_means_the_same) {
  auto ours = mission_of(1).front();
  ours.frame = number(mav_frame::global_relative_alt_int);
  ours.param2 = 1;
  ours.z = 30.004F;
  auto theirs = ours;
  theirs.frame = number(mav_frame::global_relative_alt);
  theirs.param2 = 0;
  theirs.autocontinue = 0;
  theirs.current = 1;
  theirs.z = 30.0F;
  EXPECT_TRUE(means_the_same(ours, theirs));
}

TEST(meaning, another_command_position_or_altitude_is_another_meaning) {
  const auto ours = mission_of(1).front();
  auto theirs = ours;
  theirs.command = 17;
  EXPECT_FALSE(means_the_same(ours, theirs));
  theirs = ours;
  theirs.x += 1'000;
  EXPECT_FALSE(means_the_same(ours, theirs));
  theirs = ours;
  theirs.z += 1;
  EXPECT_FALSE(means_the_same(ours, theirs));
}

TEST(meaning, an_altitude_above_home_is_not_one_above_the_sea) {
  auto ours = mission_of(1).front();
  ours.frame = number(mav_frame::global_relative_alt);
  auto theirs = ours;
  theirs.frame = number(mav_frame::global);
  EXPECT_FALSE(means_the_same(ours, theirs));
}

TEST(meaning, the_frame_of_an_item_without_position_says_nothing) {
  mission_item_int ours;
  ours.command = 20; // return to launch
  ours.frame = number(mav_frame::global_relative_alt);
  auto theirs = ours;
  theirs.frame = number(mav_frame::global);
  EXPECT_TRUE(means_the_same(ours, theirs));
}

TEST(meaning, not_a_number_comes_back_as_zero) {
  auto ours = mission_of(1).front();
  auto theirs = ours;
  ours.z = std::nanf("");
  theirs.z = 0;
  EXPECT_TRUE(means_the_same(ours, theirs));
}

TEST(meaning, another_speed_is_another_meaning) {
  mission_item_int ours;
  ours.command = 178; // DO_CHANGE_SPEED
  ours.param2 = 5;
  auto theirs = ours;
  theirs.param2 = 5.001F;
  EXPECT_TRUE(means_the_same(ours, theirs));
  theirs.param2 = 8;
  EXPECT_FALSE(means_the_same(ours, theirs));
}

TEST(meaning, to_stay_longer_is_another_meaning_but_for_a_time_that_is_not_kept) {
  for (const std::uint16_t command : {16, 19, 93}) { // NAV_WAYPOINT, NAV_LOITER_TIME, NAV_DELAY
    auto ours = mission_of(1).front();
    ours.command = command;
    ours.param1 = 10.5F;
    auto theirs = ours;
    theirs.param1 = 10; // whole seconds
    EXPECT_TRUE(means_the_same(ours, theirs)) << command;
    theirs.param1 = 0;
    EXPECT_TRUE(means_the_same(ours, theirs)) << command;
    theirs.param1 = 60;
    EXPECT_FALSE(means_the_same(ours, theirs)) << command;
  }
}

TEST(meaning, positions_at_both_ends_of_the_range_do_not_overflow) {
  auto ours = mission_of(1).front();
  auto theirs = ours;
  ours.x = INT32_MIN;
  theirs.x = INT32_MAX;
  EXPECT_FALSE(means_the_same(ours, theirs));
}

TEST(first_difference, names_the_item_or_the_length) {
  const auto ours = mission_of(5);
  auto theirs = ours;
  EXPECT_EQ(first_difference(ours, theirs, false), std::nullopt);
  theirs[3].x += 1'000;
  EXPECT_EQ(first_difference(ours, theirs, false), 3U);
  theirs = ours;
  theirs.pop_back();
  EXPECT_EQ(first_difference(ours, theirs, false), 4U);
}

TEST(first_difference, leaves_home_out) {
  const auto ours = mission_of(5);
  auto theirs = ours;
  theirs[0].x += 1'000;
  EXPECT_EQ(first_difference(ours, theirs, true), std::nullopt);
  EXPECT_EQ(first_difference(ours, theirs, false), 0U);
}

TEST(meaning, what_stands_in_a_command_without_a_place_says_nothing) {
  auto ours = mission_of(1).front();
  ours.command = number(mav_cmd::do_set_servo);
  ours.frame = number(mav_frame::global_relative_alt);
  auto theirs = ours;
  theirs.x = theirs.y = 0;
  theirs.z = 0;
  theirs.frame = number(mav_frame::global);
  EXPECT_TRUE(means_the_same(ours, theirs)) << "ArduPilot keeps none of it";
  ours.command = theirs.command = number(mav_cmd::do_set_roi_location);
  EXPECT_FALSE(means_the_same(ours, theirs)) << "this one looks there";
}

TEST(meaning, another_jump_is_another_meaning) {
  mission_item_int ours;
  ours.command = number(mav_cmd::do_jump);
  ours.param1 = 2;
  ours.param2 = 3;
  auto theirs = ours;
  EXPECT_TRUE(means_the_same(ours, theirs));
  theirs.param1 = 1;
  EXPECT_FALSE(means_the_same(ours, theirs));
  theirs = ours;
  theirs.param2 = -1;
  EXPECT_FALSE(means_the_same(ours, theirs));
}

TEST(meaning, what_px4_keeps_as_another_command_means_the_same) {
  for (const auto& [sent, kept] :
       {std::pair(mav_cmd::nav_roi, mav_cmd::do_set_roi), std::pair(mav_cmd::condition_delay, mav_cmd::nav_delay)}) {
    mission_item_int ours;
    ours.command = number(sent);
    auto theirs = ours;
    theirs.command = number(kept);
    EXPECT_TRUE(means_the_same(ours, theirs)) << int{ours.command};
  }
}

} // namespace plan_meaning_test
} // namespace godwit::io::mavlink
