// The numbers in commands and their answers. See io/mavlink/enums.hpp.
#pragma once

#include <cstdint>

#include "io/fields/field_table.hpp"

namespace godwit::io::mavlink {

// The answer to a command. Accepted means that the vehicle will try, not that it has done it.
enum class mav_result : std::uint8_t {
  accepted = 0,
  temporarily_rejected = 1,
  denied = 2,
  unsupported = 3,
  failed = 4,
  in_progress = 5,
  cancelled = 6,
  command_long_only = 7,
  command_int_only = 8,
  unsupported_mav_frame = 9,
  not_in_control = 10,
};

constexpr auto enum_names(mav_result) {
  return names<mav_result>({{mav_result::accepted, "accepted"},
                            {mav_result::temporarily_rejected, "temporarily_rejected"},
                            {mav_result::denied, "denied"},
                            {mav_result::unsupported, "unsupported"},
                            {mav_result::failed, "failed"},
                            {mav_result::in_progress, "in_progress"},
                            {mav_result::cancelled, "cancelled"},
                            {mav_result::command_long_only, "command_long_only"},
                            {mav_result::command_int_only, "command_int_only"},
                            {mav_result::unsupported_mav_frame, "unsupported_mav_frame"},
                            {mav_result::not_in_control, "not_in_control"}});
}

// Commands, as items of a plan or as orders. What their parameters mean:
enum class mav_cmd : std::uint16_t {
  nav_waypoint = 16,     // hold s, acceptance m, pass m, yaw; position
  nav_loiter_unlim = 17, // -, -, radius m, yaw; position
  nav_return_to_launch = 20,
  nav_land = 21,                // abort altitude m, mode, -, yaw; position
  nav_takeoff = 22,             // pitch, -, flags, yaw; position
  nav_last = 95,                // the upper bound of the NAV commands, not a command
  do_set_mode = 176,            // base mode, custom mode, custom submode
  do_change_speed = 178,        // 0 air, 1 ground, 2 climb, 3 descent; m/s, -1 keep, -2 default; throttle %
  do_change_altitude = 186,     // altitude m, frame
  do_reposition = 192,          // speed m/s, flags, radius m, yaw; position
  do_pause_continue = 193,      // 0 pause, 1 continue
  do_set_mission_current = 224, // item, -1 keep; 1 reset the mission
  mission_start = 300,          // first item, last item
  component_arm_disarm = 400,   // 1 arm, 0 disarm; 21196 force
  set_message_interval = 511,   // message id, interval us: 0 default, -1 off
  request_message = 512,        // message id
  nav_fence_return_point = 5000,
  nav_fence_polygon_vertex_inclusion = 5001, // vertices of the polygon; position
  nav_fence_polygon_vertex_exclusion = 5002, // the same
  nav_fence_circle_inclusion = 5003,         // radius m; position
  nav_fence_circle_exclusion = 5004,         // the same
  nav_rally_point = 5100,                    // position
};

constexpr auto enum_names(mav_cmd) {
  return names<mav_cmd>({{mav_cmd::nav_waypoint, "nav_waypoint"},
                         {mav_cmd::nav_loiter_unlim, "nav_loiter_unlim"},
                         {mav_cmd::nav_return_to_launch, "nav_return_to_launch"},
                         {mav_cmd::nav_land, "nav_land"},
                         {mav_cmd::nav_takeoff, "nav_takeoff"},
                         {mav_cmd::nav_last, "nav_last"},
                         {mav_cmd::do_set_mode, "do_set_mode"},
                         {mav_cmd::do_change_speed, "do_change_speed"},
                         {mav_cmd::do_change_altitude, "do_change_altitude"},
                         {mav_cmd::do_reposition, "do_reposition"},
                         {mav_cmd::do_pause_continue, "do_pause_continue"},
                         {mav_cmd::do_set_mission_current, "do_set_mission_current"},
                         {mav_cmd::mission_start, "mission_start"},
                         {mav_cmd::component_arm_disarm, "component_arm_disarm"},
                         {mav_cmd::set_message_interval, "set_message_interval"},
                         {mav_cmd::request_message, "request_message"},
                         {mav_cmd::nav_fence_return_point, "nav_fence_return_point"},
                         {mav_cmd::nav_fence_polygon_vertex_inclusion, "nav_fence_polygon_vertex_inclusion"},
                         {mav_cmd::nav_fence_polygon_vertex_exclusion, "nav_fence_polygon_vertex_exclusion"},
                         {mav_cmd::nav_fence_circle_inclusion, "nav_fence_circle_inclusion"},
                         {mav_cmd::nav_fence_circle_exclusion, "nav_fence_circle_exclusion"},
                         {mav_cmd::nav_rally_point, "nav_rally_point"}});
}

} // namespace godwit::io::mavlink
