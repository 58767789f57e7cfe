// The commands that flight knows as items of a mission, by their numbers. Thread: constants. Source: MAV_CMD of
// MAVLink's common.xml.
#pragma once

#include <cstdint>

#include "io/mavlink/enums/command.hpp"

namespace godwit::sim {

constexpr auto nav_waypoint = static_cast<std::uint16_t>(io::mavlink::mav_cmd::nav_waypoint);
constexpr auto nav_loiter_unlim = static_cast<std::uint16_t>(io::mavlink::mav_cmd::nav_loiter_unlim);
constexpr std::uint16_t nav_loiter_turns = 18; // turns, -, radius m; position
constexpr std::uint16_t nav_loiter_time = 19;  // s; position
constexpr auto nav_return_to_launch = static_cast<std::uint16_t>(io::mavlink::mav_cmd::nav_return_to_launch);
constexpr auto nav_land = static_cast<std::uint16_t>(io::mavlink::mav_cmd::nav_land);
constexpr auto nav_takeoff = static_cast<std::uint16_t>(io::mavlink::mav_cmd::nav_takeoff);
constexpr std::uint16_t nav_spline_waypoint = 82; // as nav_waypoint
constexpr std::uint16_t nav_delay = 93;           // s, or -1 and a time of day
constexpr auto last_nav_command = static_cast<std::uint16_t>(io::mavlink::mav_cmd::nav_last);
constexpr std::uint16_t condition_delay = 112; // s: the commands behind it wait
constexpr std::uint16_t do_jump = 177;         // sequence, repeats or -1
constexpr auto do_change_speed = static_cast<std::uint16_t>(io::mavlink::mav_cmd::do_change_speed);
constexpr std::uint16_t do_set_home = 179;   // 1 here, 0 the position
constexpr std::uint16_t do_land_start = 189; // a mark in the plan: nothing to do

} // namespace godwit::sim
