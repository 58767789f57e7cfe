#include "actors/ground_port/mission_server/item_forms.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace godwit::ground_port::mission_server {
namespace item_forms_test {

using mavlink::mav_cmd;
using mavlink::mav_frame;
using mavlink::number;

mavlink::mission_item_int form_waypoint() {
  mavlink::mission_item_int result;
  result.command = number(mav_cmd::nav_waypoint);
  result.frame = number(mav_frame::global_relative_alt_int);
  result.seq = 3;
  result.current = 1;
  result.param1 = 5;
  result.param2 = 1;
  result.x = 500'000'000;
  result.y = -364'000'000;
  result.z = 30.126F;
  result.mission_type = 1;
  return result;
}

TEST(item_forms, a_float_item_has_degrees_and_keeps_the_rest) {
  const auto item = in_floats(form_waypoint());
  EXPECT_FLOAT_EQ(item.x, 50.0F);
  EXPECT_FLOAT_EQ(item.y, -36.4F);
  EXPECT_EQ(item.seq, 3);
  EXPECT_EQ(item.command, number(mav_cmd::nav_waypoint));
  EXPECT_EQ(item.param1, 5);
  EXPECT_EQ(item.mission_type, 1);
}

TEST(item_forms, there_and_back_loses_no_more_than_a_float_does) {
  const auto back = in_integers(in_floats(form_waypoint()));
  EXPECT_NEAR(back.x, 500'000'000, 50);
  EXPECT_NEAR(back.y, -364'000'000, 50);
}

TEST(item_forms, a_local_position_has_metres_in_a_tenth_of_a_millimetre) {
  auto item = form_waypoint();
  item.frame = 1; // local
  item.x = 12'500;
  EXPECT_FLOAT_EQ(in_floats(item).x, 1.25F);
}

TEST(item_forms, x_and_y_of_an_item_without_a_position_are_parameters_and_stay_as_they_are) {
  mavlink::mission_item item;
  item.frame = number(mavlink::mav_frame::mission);
  item.x = 7;
  item.y = -3;
  EXPECT_EQ(in_integers(item).x, 7);
  EXPECT_EQ(in_integers(item).y, -3);
  EXPECT_EQ(in_floats(in_integers(item)).x, 7.0F);
}

TEST(item_forms, numbers_that_are_none_or_too_large_do_not_overflow) {
  mavlink::mission_item item;
  item.x = std::nanf("");
  item.y = std::numeric_limits<float>::infinity();
  EXPECT_EQ(in_integers(item).x, INT32_MAX) << "no position, and not the one at 0";
  EXPECT_EQ(in_integers(item).y, INT32_MAX);
}

TEST(item_forms, px4_keeps_items_as_sent) {
  const auto kept = as_kept(form_waypoint(), px4_profile());
  EXPECT_EQ(kept.frame, number(mav_frame::global_relative_alt_int));
  EXPECT_EQ(kept.param2, 1);
  EXPECT_EQ(kept.z, 30.126F);
}

TEST(item_forms, ardupilot_keeps_what_it_uses) {
  const auto kept = as_kept(form_waypoint(), ardupilot_copter_profile());
  EXPECT_EQ(kept.frame, number(mav_frame::global_relative_alt));
  EXPECT_EQ(kept.param1, 5);
  EXPECT_EQ(kept.param2, 0);
  EXPECT_EQ(kept.autocontinue, 1);
  EXPECT_EQ(kept.current, 0);
  EXPECT_NEAR(kept.z, 30.13F, 1e-4);
  auto home = form_waypoint();
  home.command = number(mav_cmd::nav_return_to_launch);
  EXPECT_EQ(as_kept(home, ardupilot_copter_profile()).frame, number(mav_frame::global));
}

TEST(item_forms, the_address_is_not_part_of_a_plan) {
  auto item = form_waypoint();
  item.target_system = 1;
  item.target_component = 1;
  EXPECT_EQ(as_kept(item, {}).target_system, 0);
  EXPECT_EQ(as_kept(item, {}).target_component, 0);
}

} // namespace item_forms_test
} // namespace godwit::ground_port::mission_server
