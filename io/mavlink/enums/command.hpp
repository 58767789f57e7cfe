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

GODWIT_ENUM_NAMES(mav_result, accepted, temporarily_rejected, denied, unsupported, failed, in_progress, cancelled,
                  command_long_only, command_int_only, unsupported_mav_frame, not_in_control);

// Commands, as items of a plan or as orders. What their parameters mean:
enum class mav_cmd : std::uint16_t {
  nav_waypoint = 16,     // hold s, acceptance m, pass m, yaw; position
  nav_loiter_unlim = 17, // -, -, radius m, yaw; position
  nav_loiter_turns = 18, // turns, leave tangentially, radius m, exit; position
  nav_loiter_time = 19,  // s, leave tangentially, radius m, exit; position
  nav_return_to_launch = 20,
  nav_land = 21,                    // abort altitude m, mode, -, yaw; position
  nav_takeoff = 22,                 // pitch, -, flags, yaw; position
  nav_continue_and_change_alt = 30, // 0 neutral, 1 climb, 2 descend; altitude in z
  nav_loiter_to_alt = 31,           // leave tangentially, radius m, -, exit; position
  do_orbit = 34,                    // radius m, m/s, yaw behaviour, turns; position
  nav_roi = 80,                     // mode, item, id; position
  nav_spline_waypoint = 82,         // hold s; position
  nav_vtol_takeoff = 84,            // -, transition heading, -, yaw; position
  nav_vtol_land = 85,               // options, -, approach altitude m, yaw; position
  nav_guided_enable = 92,           // 1 on, 0 off
  nav_delay = 93,                   // s, or -1 and a time of day: hour, minute, second
  nav_payload_place = 94,           // maximal descent m; position
  nav_last = 95,                    // the upper bound of the NAV commands, not a command
  condition_delay = 112,            // s
  condition_change_alt = 113,       // m/s; altitude in z
  condition_distance = 114,         // m to the next item
  condition_yaw = 115,              // degrees, degrees/s, direction, 1 relative
  do_set_mode = 176,                // base mode, custom mode, custom submode
  do_jump = 177,                    // item, repetitions
  do_change_speed = 178,            // 0 air, 1 ground, 2 climb, 3 descent; m/s, -1 keep, -2 default; throttle %
  do_set_home = 179,                // 1 where it is, 0 here; position
  do_set_parameter = 180,           // number, value
  do_set_relay = 181,               // number, 1 on, 0 off
  do_repeat_relay = 182,            // number, times, period s
  do_set_servo = 183,               // number, pulse us
  do_repeat_servo = 184,            // number, pulse us, times, period s
  do_change_altitude = 186,         // altitude m, frame
  do_set_actuator = 187,            // values of six, -1 to 1
  do_return_path_start = 188,       // the way back begins here; position
  do_land_start = 189,              // the landing begins here; position
  do_go_around = 191,               // altitude m
  do_reposition = 192,              // speed m/s, flags, radius m, yaw; position
  do_pause_continue = 193,          // 0 pause, 1 continue
  do_set_reverse = 194,             // 1 backwards, 0 forwards
  do_set_roi_location = 195,        // gimbal; position
  do_set_roi_wpnext_offset = 196,   // gimbal; offsets of pitch, roll, yaw
  do_set_roi_none = 197,            // gimbal
  do_set_roi_sysid = 198,           // system, gimbal
  do_control_video = 200,           // camera, transmission, interval s, recording
  do_set_roi = 201,                 // mode, item, id; position
  do_digicam_configure = 202,       // settings of a camera
  do_digicam_control = 203,         // session, zoom, zoom step, focus lock, shoot
  do_mount_configure = 204,         // mode, what is stabilised
  do_mount_control = 205,           // pitch, roll, yaw
  do_set_cam_trigg_dist = 206,      // m between pictures, 0 none; shutter ms, 1 one at once
  do_fence_enable = 207,            // 0 off, 1 on, 2 floor off
  do_parachute = 208,               // 0 off, 1 on, 2 release
  do_inverted_flight = 210,         // 1 inverted
  do_gripper = 211,                 // number, 0 open, 1 close
  do_autotune_enable = 212,         // 1 on, axes
  nav_set_yaw_speed = 213,          // degrees, m/s, 1 relative
  do_set_cam_trigg_interval = 214,  // ms between pictures, shutter ms
  do_mount_control_quat = 220,      // quaternion
  do_guided_limits = 222,           // s, lowest m, highest m, horizontal m
  do_engine_control = 223,          // 1 start, 0 stop
  do_set_mission_current = 224,     // item, -1 keep; 1 reset the mission
  preflight_reboot_shutdown = 246,  // 1 the autopilot starts again, 2 shuts down
  mission_start = 300,              // first item, last item
  component_arm_disarm = 400,       // 1 arm, 0 disarm; 21196 force
  get_home_position = 410,
  get_message_interval = 510, // message id
  set_message_interval = 511, // message id, interval us: 0 default, -1 off
  request_message = 512,      // message id
  request_protocol_version = 519,
  request_autopilot_capabilities = 520,
  set_camera_mode = 530,                     // camera, mode
  set_camera_zoom = 531,                     // type, value
  set_camera_focus = 532,                    // type, value
  set_camera_source = 534,                   // camera, primary, secondary
  jump_tag = 600,                            // number, which do_jump_tag names
  do_jump_tag = 601,                         // number, repetitions
  do_gimbal_manager_pitchyaw = 1000,         // degrees, degrees/s, flags
  image_start_capture = 2000,                // camera, interval s, pictures
  image_stop_capture = 2001,                 // camera
  do_trigger_control = 2003,                 // 1 on, 0 off; 1 reset, 1 pause
  video_start_capture = 2500,                // stream, status Hz
  video_stop_capture = 2501,                 // stream
  do_vtol_transition = 3000,                 // 3 hover, 4 fixed wing
  condition_gate = 4501,                     // geometry; position
  nav_fence_return_point = 5000,             // position
  nav_fence_polygon_vertex_inclusion = 5001, // vertices of the polygon; position
  nav_fence_polygon_vertex_exclusion = 5002, // the same
  nav_fence_circle_inclusion = 5003,         // radius m; position
  nav_fence_circle_exclusion = 5004,         // the same
  nav_rally_point = 5100,                    // position
};

constexpr auto enum_names(mav_cmd) {
  return names<mav_cmd>({{mav_cmd::nav_waypoint, "nav_waypoint"},
                         {mav_cmd::nav_loiter_unlim, "nav_loiter_unlim"},
                         {mav_cmd::nav_loiter_turns, "nav_loiter_turns"},
                         {mav_cmd::nav_loiter_time, "nav_loiter_time"},
                         {mav_cmd::nav_return_to_launch, "nav_return_to_launch"},
                         {mav_cmd::nav_land, "nav_land"},
                         {mav_cmd::nav_takeoff, "nav_takeoff"},
                         {mav_cmd::nav_continue_and_change_alt, "nav_continue_and_change_alt"},
                         {mav_cmd::nav_loiter_to_alt, "nav_loiter_to_alt"},
                         {mav_cmd::do_orbit, "do_orbit"},
                         {mav_cmd::nav_roi, "nav_roi"},
                         {mav_cmd::nav_spline_waypoint, "nav_spline_waypoint"},
                         {mav_cmd::nav_vtol_takeoff, "nav_vtol_takeoff"},
                         {mav_cmd::nav_vtol_land, "nav_vtol_land"},
                         {mav_cmd::nav_guided_enable, "nav_guided_enable"},
                         {mav_cmd::nav_delay, "nav_delay"},
                         {mav_cmd::nav_payload_place, "nav_payload_place"},
                         {mav_cmd::nav_last, "nav_last"},
                         {mav_cmd::condition_delay, "condition_delay"},
                         {mav_cmd::condition_change_alt, "condition_change_alt"},
                         {mav_cmd::condition_distance, "condition_distance"},
                         {mav_cmd::condition_yaw, "condition_yaw"},
                         {mav_cmd::do_set_mode, "do_set_mode"},
                         {mav_cmd::do_jump, "do_jump"},
                         {mav_cmd::do_change_speed, "do_change_speed"},
                         {mav_cmd::do_set_home, "do_set_home"},
                         {mav_cmd::do_set_parameter, "do_set_parameter"},
                         {mav_cmd::do_set_relay, "do_set_relay"},
                         {mav_cmd::do_repeat_relay, "do_repeat_relay"},
                         {mav_cmd::do_set_servo, "do_set_servo"},
                         {mav_cmd::do_repeat_servo, "do_repeat_servo"},
                         {mav_cmd::do_change_altitude, "do_change_altitude"},
                         {mav_cmd::do_set_actuator, "do_set_actuator"},
                         {mav_cmd::do_return_path_start, "do_return_path_start"},
                         {mav_cmd::do_land_start, "do_land_start"},
                         {mav_cmd::do_go_around, "do_go_around"},
                         {mav_cmd::do_reposition, "do_reposition"},
                         {mav_cmd::do_pause_continue, "do_pause_continue"},
                         {mav_cmd::do_set_reverse, "do_set_reverse"},
                         {mav_cmd::do_set_roi_location, "do_set_roi_location"},
                         {mav_cmd::do_set_roi_wpnext_offset, "do_set_roi_wpnext_offset"},
                         {mav_cmd::do_set_roi_none, "do_set_roi_none"},
                         {mav_cmd::do_set_roi_sysid, "do_set_roi_sysid"},
                         {mav_cmd::do_control_video, "do_control_video"},
                         {mav_cmd::do_set_roi, "do_set_roi"},
                         {mav_cmd::do_digicam_configure, "do_digicam_configure"},
                         {mav_cmd::do_digicam_control, "do_digicam_control"},
                         {mav_cmd::do_mount_configure, "do_mount_configure"},
                         {mav_cmd::do_mount_control, "do_mount_control"},
                         {mav_cmd::do_set_cam_trigg_dist, "do_set_cam_trigg_dist"},
                         {mav_cmd::do_fence_enable, "do_fence_enable"},
                         {mav_cmd::do_parachute, "do_parachute"},
                         {mav_cmd::do_inverted_flight, "do_inverted_flight"},
                         {mav_cmd::do_gripper, "do_gripper"},
                         {mav_cmd::do_autotune_enable, "do_autotune_enable"},
                         {mav_cmd::nav_set_yaw_speed, "nav_set_yaw_speed"},
                         {mav_cmd::do_set_cam_trigg_interval, "do_set_cam_trigg_interval"},
                         {mav_cmd::do_mount_control_quat, "do_mount_control_quat"},
                         {mav_cmd::do_guided_limits, "do_guided_limits"},
                         {mav_cmd::do_engine_control, "do_engine_control"},
                         {mav_cmd::do_set_mission_current, "do_set_mission_current"},
                         {mav_cmd::preflight_reboot_shutdown, "preflight_reboot_shutdown"},
                         {mav_cmd::mission_start, "mission_start"},
                         {mav_cmd::component_arm_disarm, "component_arm_disarm"},
                         {mav_cmd::get_home_position, "get_home_position"},
                         {mav_cmd::get_message_interval, "get_message_interval"},
                         {mav_cmd::set_message_interval, "set_message_interval"},
                         {mav_cmd::request_message, "request_message"},
                         {mav_cmd::request_protocol_version, "request_protocol_version"},
                         {mav_cmd::request_autopilot_capabilities, "request_autopilot_capabilities"},
                         {mav_cmd::set_camera_mode, "set_camera_mode"},
                         {mav_cmd::set_camera_zoom, "set_camera_zoom"},
                         {mav_cmd::set_camera_focus, "set_camera_focus"},
                         {mav_cmd::set_camera_source, "set_camera_source"},
                         {mav_cmd::jump_tag, "jump_tag"},
                         {mav_cmd::do_jump_tag, "do_jump_tag"},
                         {mav_cmd::do_gimbal_manager_pitchyaw, "do_gimbal_manager_pitchyaw"},
                         {mav_cmd::image_start_capture, "image_start_capture"},
                         {mav_cmd::image_stop_capture, "image_stop_capture"},
                         {mav_cmd::do_trigger_control, "do_trigger_control"},
                         {mav_cmd::video_start_capture, "video_start_capture"},
                         {mav_cmd::video_stop_capture, "video_stop_capture"},
                         {mav_cmd::do_vtol_transition, "do_vtol_transition"},
                         {mav_cmd::condition_gate, "condition_gate"},
                         {mav_cmd::nav_fence_return_point, "nav_fence_return_point"},
                         {mav_cmd::nav_fence_polygon_vertex_inclusion, "nav_fence_polygon_vertex_inclusion"},
                         {mav_cmd::nav_fence_polygon_vertex_exclusion, "nav_fence_polygon_vertex_exclusion"},
                         {mav_cmd::nav_fence_circle_inclusion, "nav_fence_circle_inclusion"},
                         {mav_cmd::nav_fence_circle_exclusion, "nav_fence_circle_exclusion"},
                         {mav_cmd::nav_rally_point, "nav_rally_point"}});
}

} // namespace godwit::io::mavlink
