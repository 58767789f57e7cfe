#include "actors/ground_port/mission_server/item_commands.hpp"

#include <gtest/gtest.h>

namespace godwit::ground_port::mission_server {
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
} // namespace godwit::ground_port::mission_server
