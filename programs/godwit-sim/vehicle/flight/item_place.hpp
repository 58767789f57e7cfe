// Where an item of a mission lies. Thread: pure. Source: MAV_FRAME and MISSION_ITEM_INT of MAVLink's common.xml.
#pragma once

#include <cstdint>
#include <string>

#include <tl/expected.hpp>

#include "io/mavlink/enums.hpp"
#include "io/mavlink/messages/mission_transfer.hpp"
#include "programs/godwit-sim/vehicle/world/position.hpp"

namespace godwit::sim {

struct item_place {
  position at;
  bool is_here = false;          // the item has no place of its own: where the vehicle is
  bool has_own_altitude = false; // otherwise that of the vehicle
};

// Frames 0 and 5 count altitudes from mean sea level, 3, 6 and (for want of hills) 10 and 11 from home; 2 has no
// position. The largest integer as a coordinate means here, as does 0, 0 for take-off, landing and loiter, and then an
// altitude of 0 is none either. The error is a sentence for people: no such frame, or not on Earth.
[[nodiscard]] tl::expected<item_place, std::string> place_of(const io::mavlink::mission_item_int& item,
                                                             const position& home, const position& here);

// The commands that flight knows as items of a mission, as the numbers that items hold. Thread: constants.
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
constexpr auto condition_distance = io::mavlink::number(io::mavlink::mav_cmd::condition_distance);
constexpr auto do_gripper = io::mavlink::number(io::mavlink::mav_cmd::do_gripper);
constexpr auto do_set_cam_trigg_dist = io::mavlink::number(io::mavlink::mav_cmd::do_set_cam_trigg_dist);
constexpr auto image_start_capture = io::mavlink::number(io::mavlink::mav_cmd::image_start_capture);
constexpr auto do_vtol_transition = io::mavlink::number(io::mavlink::mav_cmd::do_vtol_transition);
constexpr auto do_set_roi = io::mavlink::number(io::mavlink::mav_cmd::do_set_roi);
constexpr auto do_set_roi_location = io::mavlink::number(io::mavlink::mav_cmd::do_set_roi_location);
constexpr auto do_set_roi_none = io::mavlink::number(io::mavlink::mav_cmd::do_set_roi_none);
constexpr auto do_jump = io::mavlink::number(io::mavlink::mav_cmd::do_jump);
constexpr auto do_change_speed = io::mavlink::number(io::mavlink::mav_cmd::do_change_speed);
constexpr auto do_set_home = io::mavlink::number(io::mavlink::mav_cmd::do_set_home);
constexpr auto do_land_start = io::mavlink::number(io::mavlink::mav_cmd::do_land_start);

} // namespace godwit::sim
