// Plans as ground stations write them, and a flight that has no other source of missions. For tests.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "io/mavlink/enums.hpp"
#include "io/mavlink/plan_meaning.hpp"
#include "tests/actors/executor/flight_world.hpp"
#include "tests/support/station_items.hpp"

namespace godwit::executor {

using io::mavlink::mav_cmd;
using io::mavlink::mav_frame;
using io::mavlink::mav_mission_type;
using io::mavlink::mission_item_int;
using io::mavlink::number;
using tests::flight_world;
using tests::item_of;
using tests::numbered;
using tests::station_items;
using tests::upload;
using tests::waypoint_at;

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
