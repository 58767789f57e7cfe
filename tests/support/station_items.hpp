// Plans as ground stations write them, around the home of the simulated vehicles. For tests.
#pragma once

#include <cstdint>
#include <utility>
#include <variant>
#include <vector>

#include "io/mavlink/enums.hpp"
#include "io/mavlink/messages/mission_transfer.hpp"
#include "tests/support/short_mission.hpp"

namespace godwit::tests {

using upload = std::vector<io::mavlink::mission_item_int>;

inline io::mavlink::mission_item_int item_of(io::mavlink::mav_cmd command, const mission::position& at) {
  io::mavlink::mission_item_int result;
  result.command = io::mavlink::number(command);
  result.frame = io::mavlink::number(io::mavlink::mav_frame::global_relative_alt_int);
  result.autocontinue = 1;
  result.x = static_cast<std::int32_t>(at.latitude * 1e7);
  result.y = static_cast<std::int32_t>(at.longitude * 1e7);
  result.z = static_cast<float>(at.altitude_m);
  return result;
}

inline io::mavlink::mission_item_int waypoint_at(sim::personality who, double north_m, double east_m) {
  return item_of(io::mavlink::mav_cmd::nav_waypoint, std::get<mission::waypoint>(place(who, "", north_m, east_m)).at);
}

inline upload numbered(upload items) {
  for (std::size_t i = 0; i < items.size(); ++i)
    items[i].seq = static_cast<std::uint16_t>(i);
  return items;
}

// Take-off, speed, two waypoints, return; as a station writes it.
inline upload station_items(sim::personality who) {
  using io::mavlink::mav_cmd;
  const bool drives = who == sim::personality::rover;
  const double up_m = drives ? 0 : 20;
  upload result;
  if (!drives)
    result.push_back(item_of(mav_cmd::nav_takeoff, {0, 0, up_m}));
  auto speed = item_of(mav_cmd::do_change_speed, {});
  speed.frame = io::mavlink::number(io::mavlink::mav_frame::mission);
  speed.param1 = 1;
  speed.param2 = 4;
  result.push_back(speed);
  result.push_back(waypoint_at(who, 60, 0));
  result.push_back(waypoint_at(who, 60, 60));
  if (who == sim::personality::plane) {
    result.push_back(item_of(mav_cmd::nav_land, std::get<mission::land>(way_home(who)).at));
  } else if (!drives) {
    auto back = item_of(mav_cmd::nav_return_to_launch, {});
    back.frame = io::mavlink::number(io::mavlink::mav_frame::mission);
    result.push_back(back);
  }
  return numbered(result);
}

} // namespace godwit::tests
