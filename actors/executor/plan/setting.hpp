// What a plan depends on besides the mission: the kind of vehicle, its autopilot, where it is and where its home is.
// Degrees (WGS 84), metres. Thread: plain values.
#pragma once

#include <optional>

#include "actors/domain/mission/commands/command_policy.hpp"
#include "actors/domain/mission/commands/command_table.hpp"
#include "io/fields/field_table.hpp"
#include "io/mavlink/enums/vehicle.hpp"
#include "io/mavlink/messages/mission_transfer.hpp"
#include "messages/flight/home_place.hpp"
#include "messages/flight/vehicle_class.hpp"
#include "messages/mission/place.hpp"

namespace godwit::executor::plan {

using flight::vehicle_class;

// Where the autopilot returns to, and what it counts altitudes from. PX4 and ArduPilot move it to where they arm.
struct vehicle_home {
  double latitude = 0;
  double longitude = 0;
  double above_sea_m = 0;
  // Above the place that the mission counts altitudes from, which is where it first took off. Another one after a
  // landing on a hill: whoever plans the flight from there says how high the hill is.
  double above_mission_zero_m = 0;
};

[[nodiscard]] inline flight::home_place place_of(const vehicle_home& home) {
  return {home.latitude, home.longitude, home.above_sea_m};
}

struct plan_setting {
  vehicle_class vehicle = vehicle_class::multirotor;
  // PX4 and ArduPilot are treated as they are, all others by the MAVLink text.
  io::mavlink::mav_autopilot autopilot = io::mavlink::mav_autopilot::px4;
  vehicle_home home;
  mission::position start;   // where the vehicle is when the first plan begins; altitude as in the mission
  bool is_under_way = false; // it flies, or is a rover that has begun to drive; else it stands, and home moves to there
  // After a landing on the way: `home` is that of the mission, and is set again for the flight that begins here.
  bool is_home_set_again = false;

  // Of the vehicle's own circles, where an item leaves the radius to it. PX4 has 80 m (NAV_LOITER_RAD), ArduPilot 60 m
  // (WP_LOITER_RAD), if nobody changed it. Decides what is looked at when circles are compared with fences.
  double own_loiter_radius_m = 80;
  // To which the vehicle climbs first when it returns, if it is lower (PX4: RTL_RETURN_ALT; ArduPilot: RTL_ALT).
  double return_altitude_m = 0;
  // A fixed wing's way down begins with DO_LAND_START, so that a failsafe finds it. An ArduPilot plane then does not
  // arm unless its RTL_AUTOLAND is set: not to be had without asking.
  bool marks_landings = false;
  // Which commands it takes, passes over and refuses; absent: not known, and all are believed to be taken.
  std::optional<mission::vehicle_profile> profile;
  mission::allowed_commands allowed_commands; // flight.allowed_commands
  // What ends the pictures of the line on which the vehicle is: each plan that takes it from there begins with it.
  std::optional<io::mavlink::mission_item_int> stops_camera = {};
};

// Where the vehicle returns to by itself when it flies the plans of WHERE: home moves to where it is armed, unless it
// is under way or its home is set again.
[[nodiscard]] inline mission::position home_of(const plan_setting& where) {
  if (where.is_under_way || where.is_home_set_again)
    return {where.home.latitude, where.home.longitude, where.home.above_mission_zero_m};
  return where.start;
}

} // namespace godwit::executor::plan
