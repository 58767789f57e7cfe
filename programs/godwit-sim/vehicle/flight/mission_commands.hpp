// The commands that flight knows as items of a mission, as the numbers that items hold. Thread: constants.
#pragma once

#include <cstdint>

#include "io/mavlink/enums.hpp"

namespace godwit::sim {

constexpr auto nav_waypoint = io::mavlink::number(io::mavlink::mav_cmd::nav_waypoint);
constexpr auto nav_loiter_unlim = io::mavlink::number(io::mavlink::mav_cmd::nav_loiter_unlim);
constexpr auto nav_loiter_turns = io::mavlink::number(io::mavlink::mav_cmd::nav_loiter_turns);
constexpr auto nav_loiter_time = io::mavlink::number(io::mavlink::mav_cmd::nav_loiter_time);
constexpr auto nav_return_to_launch = io::mavlink::number(io::mavlink::mav_cmd::nav_return_to_launch);
constexpr auto nav_land = io::mavlink::number(io::mavlink::mav_cmd::nav_land);
constexpr auto nav_takeoff = io::mavlink::number(io::mavlink::mav_cmd::nav_takeoff);
constexpr auto nav_spline_waypoint = io::mavlink::number(io::mavlink::mav_cmd::nav_spline_waypoint);
constexpr auto nav_continue_and_change_alt = io::mavlink::number(io::mavlink::mav_cmd::nav_continue_and_change_alt);
constexpr auto nav_loiter_to_alt = io::mavlink::number(io::mavlink::mav_cmd::nav_loiter_to_alt);
constexpr auto nav_roi = io::mavlink::number(io::mavlink::mav_cmd::nav_roi);
constexpr auto nav_vtol_takeoff = io::mavlink::number(io::mavlink::mav_cmd::nav_vtol_takeoff);
constexpr auto nav_vtol_land = io::mavlink::number(io::mavlink::mav_cmd::nav_vtol_land);
constexpr auto nav_payload_place = io::mavlink::number(io::mavlink::mav_cmd::nav_payload_place);
constexpr auto nav_delay = io::mavlink::number(io::mavlink::mav_cmd::nav_delay);
constexpr auto last_nav_command = io::mavlink::number(io::mavlink::mav_cmd::nav_last);
constexpr auto condition_delay = io::mavlink::number(io::mavlink::mav_cmd::condition_delay);
constexpr auto do_jump = io::mavlink::number(io::mavlink::mav_cmd::do_jump);
constexpr auto do_change_speed = io::mavlink::number(io::mavlink::mav_cmd::do_change_speed);
constexpr auto do_set_home = io::mavlink::number(io::mavlink::mav_cmd::do_set_home);
constexpr auto do_land_start = io::mavlink::number(io::mavlink::mav_cmd::do_land_start);

} // namespace godwit::sim
