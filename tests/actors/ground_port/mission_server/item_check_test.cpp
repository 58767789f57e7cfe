#include "actors/ground_port/mission_server/item_check.hpp"

#include <gtest/gtest.h>

namespace godwit::ground_port::mission_server {
namespace item_check_test {

using mavlink::mav_cmd;
using mavlink::mav_mission_result;
using mavlink::mav_mission_type;
using mavlink::number;

mavlink::mission_item_int waypoint() {
  mavlink::mission_item_int result;
  result.command = number(mav_cmd::nav_waypoint);
  result.frame = number(mavlink::mav_frame::global_relative_alt);
  result.x = 500'000'000;
  result.y = 364'000'000;
  return result;
}

TEST(check_item, takes_a_waypoint) { EXPECT_EQ(check_item(waypoint(), {}), mav_mission_result::accepted); }

TEST(check_item, refuses_commands_that_it_does_not_know) {
  auto item = waypoint();
  item.command = 9'999;
  EXPECT_EQ(check_item(item, {}), mav_mission_result::unsupported);
}

TEST(check_item, refuses_commands_of_another_type_of_plan) {
  auto item = waypoint();
  item.mission_type = number(mav_mission_type::fence);
  EXPECT_EQ(check_item(item, {}), mav_mission_result::unsupported);
  item.command = number(mav_cmd::nav_fence_circle_inclusion);
  EXPECT_EQ(check_item(item, {}), mav_mission_result::accepted);
  item.mission_type = number(mav_mission_type::mission);
  EXPECT_EQ(check_item(item, {}), mav_mission_result::unsupported);
  item.mission_type = number(mav_mission_type::rally);
  item.command = number(mav_cmd::nav_rally_point);
  EXPECT_EQ(check_item(item, {}), mav_mission_result::accepted);
}

TEST(check_item, refuses_frames_that_it_does_not_know) {
  auto item = waypoint();
  item.frame = 200;
  EXPECT_EQ(check_item(item, {}), mav_mission_result::unsupported_frame);
}

TEST(check_item, refuses_positions_that_are_not_on_earth_where_the_vehicle_looks) {
  auto item = waypoint();
  item.x = 950'000'000;
  EXPECT_EQ(check_item(item, {}), mav_mission_result::invalid_param5_x);
  EXPECT_EQ(check_item(item, px4_quirks()), mav_mission_result::accepted);
  item.x = INT32_MIN;
  EXPECT_EQ(check_item(item, {}), mav_mission_result::invalid_param5_x);
  item = waypoint();
  item.y = 1'810'000'000;
  EXPECT_EQ(check_item(item, {}), mav_mission_result::invalid_param6_y);
}

TEST(check_item, looks_for_a_position_only_where_there_is_one) {
  auto item = waypoint();
  item.x = 950'000'000;
  item.command = number(mav_cmd::do_digicam_control);
  EXPECT_EQ(check_item(item, {}), mav_mission_result::accepted) << "param5 of a camera";
  item.command = number(mav_cmd::nav_waypoint);
  item.frame = number(mavlink::mav_frame::mission);
  EXPECT_EQ(check_item(item, {}), mav_mission_result::accepted);
}

TEST(check_item, refuses_orders) {
  auto item = waypoint();
  item.command = number(mav_cmd::component_arm_disarm);
  EXPECT_EQ(check_item(item, {}), mav_mission_result::unsupported);
}

} // namespace item_check_test
} // namespace godwit::ground_port::mission_server
