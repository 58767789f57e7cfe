// Is this a fence? Asked item by item, as the items come.
//
// A polygon is a run of vertices, at least 3, all of one command, each with the number of vertices of its polygon in
// param1. A circle has its radius there. Thread: one at a time. Source: MAVLink, MAV_CMD_NAV_FENCE_*.
#pragma once

#include <cstdint>

#include "actors/ground_port/mission_server/autopilot_quirks.hpp"

namespace godwit::ground_port::mission_server {

class fence_check {
public:
  // Of COUNT items.
  fence_check(const fence_quirks& vehicle, int count) : vehicle_(vehicle), items_left_(count) {}

  // The next item. False: the fence is none, because of it.
  [[nodiscard]] bool takes(const mavlink::mission_item_int& item);

private:
  fence_quirks vehicle_;
  int items_left_;
  int vertices_left_ = 0; // of the polygon that has begun
  std::uint16_t command_ = 0;
  float vertices_ = 0;
};

} // namespace godwit::ground_port::mission_server
