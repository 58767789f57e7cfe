// Plans as ground stations write them, and a flight that has no other source of missions. For tests.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "io/mavlink/enums.hpp"
#include "io/mavlink/plan_checksum.hpp"
#include "tests/actors/executor/flight_world.hpp"

namespace godwit::executor {

using io::mavlink::mav_cmd;
using io::mavlink::mav_frame;
using io::mavlink::mav_mission_type;
using io::mavlink::mission_item_int;
using io::mavlink::number;
using tests::flight_world;

using upload = std::vector<mission_item_int>;

inline mission_item_int item_of(mav_cmd command, const mission::position& at) {
  mission_item_int result;
  result.command = number(command);
  result.frame = number(mav_frame::global_relative_alt_int);
  result.autocontinue = 1;
  result.x = static_cast<std::int32_t>(at.latitude * 1e7);
  result.y = static_cast<std::int32_t>(at.longitude * 1e7);
  result.z = static_cast<float>(at.altitude_m);
  return result;
}

inline mission_item_int waypoint_at(sim::personality who, double north_m, double east_m) {
  return item_of(mav_cmd::nav_waypoint, std::get<mission::waypoint>(tests::place(who, "", north_m, east_m)).at);
}

inline upload numbered(upload items) {
  for (std::size_t i = 0; i < items.size(); ++i)
    items[i].seq = static_cast<std::uint16_t>(i);
  return items;
}

// Take-off, speed, two waypoints, return; as a station writes it.
inline upload station_items(sim::personality who) {
  const bool drives = who == sim::personality::rover;
  const double up_m = drives ? 0 : 20;
  upload result;
  if (!drives)
    result.push_back(item_of(mav_cmd::nav_takeoff, {0, 0, up_m}));
  auto speed = item_of(mav_cmd::do_change_speed, {});
  speed.frame = number(mav_frame::mission);
  speed.param1 = 1;
  speed.param2 = 4;
  result.push_back(speed);
  result.push_back(waypoint_at(who, 60, 0));
  result.push_back(waypoint_at(who, 60, 60));
  if (who == sim::personality::plane) {
    result.push_back(item_of(mav_cmd::nav_land, std::get<mission::land>(tests::way_home(who)).at));
  } else if (!drives) {
    auto back = item_of(mav_cmd::nav_return_to_launch, {});
    back.frame = number(mav_frame::mission);
    result.push_back(back);
  }
  return numbered(result);
}

inline upload fence_around(sim::personality who, double half_side_m) {
  upload result;
  for (const auto& [north, east] : {std::pair{-1, -1}, {-1, 1}, {1, 1}, {1, -1}}) {
    auto corner = waypoint_at(who, north * half_side_m, east * half_side_m);
    corner.command = number(mav_cmd::nav_fence_polygon_vertex_inclusion);
    corner.param1 = 4;
    result.push_back(corner);
  }
  return numbered(result);
}

inline plan_taken taken(const upload& items, mav_mission_type type = mav_mission_type::mission) {
  return {type, io::mavlink::checksum_of(items), items, {255, 190}};
}

inline start_mission start_of(const flight_world& world, const upload& items) {
  start_mission result;
  result.key = static_cast<std::uint64_t>(world.now_ns());
  result.last = static_cast<std::uint16_t>(items.size() - 1);
  result.plan_id = io::mavlink::checksum_of(items);
  result.asked_by = {255, 190};
  result.obey_until_ns = world.wall_ns() + 3'000'000'000;
  return result;
}

inline flight_world::options by_stations(sim::personality who) {
  return {.who = who, .start = start_policy::on_command, .has_service = false};
}

inline bool was_said(const flight_world& world, const std::string& words) {
  const auto& said = world.said();
  return std::any_of(said.begin(), said.end(),
                     [&](const std::string& each) { return each.find(words) != std::string::npos; });
}

// A station uploads ITEMS, and they come to the vehicle.
inline testing::AssertionResult bring(flight_world& world, const upload& items) {
  world.station_says(taken(items));
  return world.run_until_phase(phase::ready) ? testing::AssertionSuccess()
                                             : testing::AssertionFailure() << world.story();
}

// Started, and flown until two items are reached.
inline testing::AssertionResult fly_two_items(flight_world& world, const upload& items) {
  world.station_says(start_of(world, items));
  const bool flies = world.run_until([&] { return world.shown_reached().size() >= 2; }, 600);
  return flies ? testing::AssertionSuccess() : testing::AssertionFailure() << world.story();
}

// Started, and flown to its end.
inline testing::AssertionResult fly_to_end(flight_world& world, const upload& items) {
  world.station_says(start_of(world, items));
  return world.run_until_phase(phase::done) ? testing::AssertionSuccess()
                                            : testing::AssertionFailure() << world.story();
}

} // namespace godwit::executor
