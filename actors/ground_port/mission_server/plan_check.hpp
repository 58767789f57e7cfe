// Whether an uploaded plan can be flown: its commands, its items, its fence. Thread: pure.
#pragma once

#include <cstdint>
#include <optional>

#include "actors/ground_port/mission_server/server_profile.hpp"
#include "io/mavlink/enums.hpp"

namespace godwit::ground_port::mission_server {

// Would a vehicle take this item? Thread: pure.

// `accepted`, or what is wrong with it: a command that is no item of such a plan, a frame that the vehicle does not
// know, or a position that is not on earth. Only what has a position is judged by it.
[[nodiscard]] mavlink::mav_mission_result check_item(const mavlink::mission_item_int& item,
                                                     const server_profile& vehicle);

// The commands that can be items of a plan: those that some vehicle takes, by the table of commands
// (actors/domain/mission/commands).
//
// Orders are none, though their numbers are commands as well: to arm, to start the mission, to go somewhere now.
// Thread: pure.

namespace mavlink = io::mavlink;

// Do x and y say where?
enum class item_place { anywhere, at_a_position };

// Nothing: it is no item of such a plan.
[[nodiscard]] std::optional<item_place> place_of(std::uint16_t command, mavlink::mav_mission_type type);

// Is this a fence? Asked item by item, as the items come.
//
// A polygon is a run of vertices, at least 3, all of one command, each with the number of vertices of its polygon in
// param1. A circle has its radius there. Thread: one at a time. Source: MAVLink, MAV_CMD_NAV_FENCE_*.
class fence_check {
public:
  // Of COUNT items.
  fence_check(const fence_profile& vehicle, int count) : vehicle_(vehicle), items_left_(count) {}

  // The next item. False: the fence is none, because of it.
  [[nodiscard]] bool takes(const mavlink::mission_item_int& item);

private:
  fence_profile vehicle_;
  int items_left_;
  int vertices_left_ = 0; // of the polygon that has begun
  std::uint16_t command_ = 0;
  float vertices_ = 0;
};

} // namespace godwit::ground_port::mission_server
