#include "actors/ground_port/mission_server/item_commands.hpp"

#include <algorithm>
#include <array>
#include <span>

namespace godwit::ground_port::mission_server {

namespace {

using mavlink::mav_cmd;
using mavlink::mav_mission_type;
using mavlink::number;

constexpr auto anywhere = item_place::anywhere;
constexpr auto at_a_position = item_place::at_a_position;

struct command_row {
  mav_cmd command{};
  item_place place{};
};

constexpr command_row mission_commands[] = {
    {mav_cmd::nav_waypoint, at_a_position},
    {mav_cmd::nav_loiter_unlim, at_a_position},
    {mav_cmd::nav_loiter_turns, at_a_position},
    {mav_cmd::nav_loiter_time, at_a_position},
    {mav_cmd::nav_return_to_launch, anywhere},
    {mav_cmd::nav_land, at_a_position},
    {mav_cmd::nav_takeoff, at_a_position},
    {mav_cmd::nav_continue_and_change_alt, anywhere},
    {mav_cmd::nav_loiter_to_alt, at_a_position},
    {mav_cmd::do_orbit, at_a_position},
    {mav_cmd::nav_roi, at_a_position},
    {mav_cmd::nav_spline_waypoint, at_a_position},
    {mav_cmd::nav_vtol_takeoff, at_a_position},
    {mav_cmd::nav_vtol_land, at_a_position},
    {mav_cmd::nav_guided_enable, anywhere},
    {mav_cmd::nav_delay, anywhere},
    {mav_cmd::nav_payload_place, at_a_position},
    {mav_cmd::condition_delay, anywhere},
    {mav_cmd::condition_change_alt, anywhere},
    {mav_cmd::condition_distance, anywhere},
    {mav_cmd::condition_yaw, anywhere},
    {mav_cmd::do_set_mode, anywhere},
    {mav_cmd::do_jump, anywhere},
    {mav_cmd::do_change_speed, anywhere},
    {mav_cmd::do_set_home, at_a_position},
    {mav_cmd::do_set_parameter, anywhere},
    {mav_cmd::do_set_relay, anywhere},
    {mav_cmd::do_repeat_relay, anywhere},
    {mav_cmd::do_set_servo, anywhere},
    {mav_cmd::do_repeat_servo, anywhere},
    {mav_cmd::do_change_altitude, anywhere},
    {mav_cmd::do_set_actuator, anywhere},
    {mav_cmd::do_return_path_start, at_a_position},
    {mav_cmd::do_land_start, at_a_position},
    {mav_cmd::do_go_around, anywhere},
    {mav_cmd::do_set_reverse, anywhere},
    {mav_cmd::do_set_roi_location, at_a_position},
    {mav_cmd::do_set_roi_wpnext_offset, anywhere},
    {mav_cmd::do_set_roi_none, anywhere},
    {mav_cmd::do_set_roi_sysid, anywhere},
    {mav_cmd::do_control_video, anywhere},
    {mav_cmd::do_set_roi, at_a_position},
    {mav_cmd::do_digicam_configure, anywhere},
    {mav_cmd::do_digicam_control, anywhere},
    {mav_cmd::do_mount_configure, anywhere},
    {mav_cmd::do_mount_control, anywhere},
    {mav_cmd::do_set_cam_trigg_dist, anywhere},
    {mav_cmd::do_fence_enable, anywhere},
    {mav_cmd::do_parachute, anywhere},
    {mav_cmd::do_inverted_flight, anywhere},
    {mav_cmd::do_gripper, anywhere},
    {mav_cmd::do_autotune_enable, anywhere},
    {mav_cmd::nav_set_yaw_speed, anywhere},
    {mav_cmd::do_set_cam_trigg_interval, anywhere},
    {mav_cmd::do_mount_control_quat, anywhere},
    {mav_cmd::do_guided_limits, anywhere},
    {mav_cmd::do_engine_control, anywhere},
    {mav_cmd::set_camera_mode, anywhere},
    {mav_cmd::set_camera_zoom, anywhere},
    {mav_cmd::set_camera_focus, anywhere},
    {mav_cmd::set_camera_source, anywhere},
    {mav_cmd::jump_tag, anywhere},
    {mav_cmd::do_jump_tag, anywhere},
    {mav_cmd::do_gimbal_manager_pitchyaw, anywhere},
    {mav_cmd::image_start_capture, anywhere},
    {mav_cmd::image_stop_capture, anywhere},
    {mav_cmd::do_trigger_control, anywhere},
    {mav_cmd::video_start_capture, anywhere},
    {mav_cmd::video_stop_capture, anywhere},
    {mav_cmd::do_vtol_transition, anywhere},
    {mav_cmd::condition_gate, at_a_position},
};

constexpr command_row fence_commands[] = {
    {mav_cmd::nav_fence_return_point, at_a_position},
    {mav_cmd::nav_fence_polygon_vertex_inclusion, at_a_position},
    {mav_cmd::nav_fence_polygon_vertex_exclusion, at_a_position},
    {mav_cmd::nav_fence_circle_inclusion, at_a_position},
    {mav_cmd::nav_fence_circle_exclusion, at_a_position},
};

constexpr command_row rally_commands[] = {
    {mav_cmd::nav_rally_point, at_a_position},
};

std::span<const command_row> commands_of(mav_mission_type type) {
  switch (type) {
  case mav_mission_type::fence:
    return fence_commands;
  case mav_mission_type::rally:
    return rally_commands;
  default:
    return mission_commands;
  }
}

} // namespace

std::optional<item_place> place_of(std::uint16_t command, mav_mission_type type) {
  const auto rows = commands_of(type);
  const auto row =
      std::find_if(rows.begin(), rows.end(), [&](const auto& each) { return number(each.command) == command; });
  return row == rows.end() ? std::nullopt : std::optional(row->place);
}

} // namespace godwit::ground_port::mission_server
