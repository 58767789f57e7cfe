#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "actors/ground_port/mission_server/plan_check.hpp"

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

TEST(check_item, takes_unknown_commands_that_are_allowed_as_items_of_a_mission) {
  auto item = waypoint();
  item.command = 9'999;
  server_profile vehicle;
  vehicle.also_takes = {9'998, 9'999};
  EXPECT_EQ(check_item(item, vehicle), mav_mission_result::accepted);
  item.x = 2'000'000'000;
  vehicle.checks_latitude = true;
  EXPECT_EQ(check_item(item, vehicle), mav_mission_result::invalid_param5_x);
  item.mission_type = number(mav_mission_type::fence);
  EXPECT_EQ(check_item(item, vehicle), mav_mission_result::unsupported);
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
  EXPECT_EQ(check_item(item, px4_profile()), mav_mission_result::accepted);
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

namespace item_commands_test {

using mavlink::mav_cmd;

using mavlink::mav_mission_type;

using mavlink::number;

std::optional<item_place> in_a_mission(mav_cmd command) { return place_of(number(command), mav_mission_type::mission); }

TEST(item_commands, orders_are_no_items) {
  for (const auto order :
       {mav_cmd::component_arm_disarm, mav_cmd::mission_start, mav_cmd::request_message, mav_cmd::set_message_interval,
        mav_cmd::do_reposition, mav_cmd::do_pause_continue, mav_cmd::do_set_mission_current})
    EXPECT_FALSE(in_a_mission(order)) << io::name_of(order);
  EXPECT_FALSE(in_a_mission(mav_cmd::nav_last)) << "a bound and no command";
}

TEST(item_commands, what_ground_stations_put_into_missions_is_known) {
  for (const int id : {16,  17,  18,  19,  20,  21,  22,  31,  82,  84,  85,  93,  112, 114, 115,  177,  178,  179, 181,
                       182, 183, 184, 189, 195, 196, 197, 201, 202, 203, 205, 206, 207, 211, 2000, 2001, 2500, 2501})
    EXPECT_TRUE(place_of(static_cast<std::uint16_t>(id), mav_mission_type::mission)) << id;
}

TEST(item_commands, what_every_vehicle_refuses_is_no_item) {
  for (const int id : {23, 36, 113, 176, 12'345})
    EXPECT_FALSE(place_of(static_cast<std::uint16_t>(id), mav_mission_type::mission)) << id;
}

TEST(item_commands, some_are_somewhere_and_some_are_not) {
  for (const auto command : {mav_cmd::nav_waypoint, mav_cmd::nav_spline_waypoint, mav_cmd::nav_land,
                             mav_cmd::do_set_roi_location, mav_cmd::do_land_start})
    EXPECT_EQ(in_a_mission(command), item_place::at_a_position) << io::name_of(command);
  for (const auto command : {mav_cmd::nav_return_to_launch, mav_cmd::nav_delay, mav_cmd::do_jump,
                             mav_cmd::do_digicam_control, mav_cmd::condition_yaw})
    EXPECT_EQ(in_a_mission(command), item_place::anywhere) << io::name_of(command);
}

TEST(item_commands, each_type_of_plan_has_its_own) {
  const auto waypoint = number(mav_cmd::nav_waypoint);
  const auto circle = number(mav_cmd::nav_fence_circle_inclusion);
  const auto rally_point = number(mav_cmd::nav_rally_point);
  EXPECT_FALSE(place_of(waypoint, mav_mission_type::fence));
  EXPECT_FALSE(place_of(waypoint, mav_mission_type::rally));
  EXPECT_FALSE(place_of(circle, mav_mission_type::mission));
  EXPECT_TRUE(place_of(circle, mav_mission_type::fence));
  EXPECT_FALSE(place_of(rally_point, mav_mission_type::mission));
  EXPECT_TRUE(place_of(rally_point, mav_mission_type::rally));
}

} // namespace item_commands_test

namespace fence_check_test {

using mavlink::mav_cmd;

using mavlink::number;

constexpr auto inclusion = mav_cmd::nav_fence_polygon_vertex_inclusion;
constexpr auto exclusion = mav_cmd::nav_fence_polygon_vertex_exclusion;
constexpr auto circle = mav_cmd::nav_fence_circle_exclusion;
constexpr auto return_point = mav_cmd::nav_fence_return_point;
constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

struct part {
  mav_cmd command{};
  float param1 = 0;
};

// The first item that is not taken; as many as there are: all are.
std::size_t fault_in(const std::vector<part>& fence, const fence_profile& vehicle = {}) {
  fence_check check(vehicle, static_cast<int>(fence.size()));
  for (std::size_t i = 0; i < fence.size(); ++i) {
    mavlink::mission_item_int item;
    item.command = number(fence[i].command);
    item.param1 = fence[i].param1;
    if (!check.takes(item))
      return i;
  }
  return fence.size();
}

TEST(fence_check, takes_polygons_circles_and_a_return_point_one_after_the_other) {
  EXPECT_EQ(fault_in({{inclusion, 3}, {inclusion, 3}, {inclusion, 3}}), 3U);
  EXPECT_EQ(fault_in({{circle, 0.5F},
                      {exclusion, 3},
                      {exclusion, 3},
                      {exclusion, 3},
                      {inclusion, 4},
                      {inclusion, 4},
                      {inclusion, 4},
                      {inclusion, 4},
                      {return_point, 0}}),
            9U);
}

TEST(fence_check, a_polygon_has_three_vertices_at_least) {
  EXPECT_EQ(fault_in({{inclusion, 2}, {inclusion, 2}}), 0U);
  EXPECT_EQ(fault_in({{circle, 5}, {inclusion, 0}}), 1U);
}

TEST(fence_check, a_polygon_has_as_many_vertices_as_it_says) {
  EXPECT_EQ(fault_in({{inclusion, 4}, {inclusion, 4}, {inclusion, 4}}), 0U) << "more than there are items";
  EXPECT_EQ(fault_in({{inclusion, 3}, {inclusion, 3}, {inclusion, 4}, {circle, 1}}), 2U);
  EXPECT_EQ(fault_in({{inclusion, 3}, {inclusion, 3}, {exclusion, 3}}), 2U);
  EXPECT_EQ(fault_in({{inclusion, 3}, {inclusion, 3}, {circle, 3}}), 2U);
}

TEST(fence_check, a_number_of_vertices_is_a_whole_number) {
  for (const float vertices : {nan, infinity, -infinity, -3.0F, 3.5F})
    EXPECT_EQ(fault_in({{inclusion, vertices}, {inclusion, 3}, {inclusion, 3}, {inclusion, 3}}), 0U) << vertices;
}

TEST(fence_check, a_circle_has_a_radius) {
  for (const float radius : {0.0F, -1.0F, nan, infinity})
    EXPECT_EQ(fault_in({{circle, radius}}), 0U) << radius;
}

TEST(fence_check, px4_counts_vertices_and_looks_at_nothing_else) {
  const auto px4 = px4_profile().fence;
  EXPECT_EQ(fault_in({{inclusion, 2}, {inclusion, 2}}, px4), 0U);
  EXPECT_EQ(fault_in({{inclusion, nan}}, px4), 0U);
  EXPECT_EQ(fault_in({{inclusion, 5}, {exclusion, 3}, {circle, -1}}, px4), 3U);
}

} // namespace fence_check_test

} // namespace godwit::ground_port::mission_server
