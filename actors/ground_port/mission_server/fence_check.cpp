#include "actors/ground_port/mission_server/fence_check.hpp"

#include <cmath>

namespace godwit::ground_port::mission_server {

namespace {

using mavlink::mav_cmd;
using mavlink::number;

constexpr float min_vertices = 3;

bool is_vertex(std::uint16_t command) {
  return command == number(mav_cmd::nav_fence_polygon_vertex_inclusion) ||
         command == number(mav_cmd::nav_fence_polygon_vertex_exclusion);
}

bool is_circle(std::uint16_t command) {
  return command == number(mav_cmd::nav_fence_circle_inclusion) ||
         command == number(mav_cmd::nav_fence_circle_exclusion);
}

} // namespace

bool fence_check::takes(const mavlink::mission_item_int& item) {
  const auto left = static_cast<float>(items_left_--); // this one included
  if (vehicle_.counts_vertices_only)
    return !is_vertex(item.command) || item.param1 >= min_vertices;
  if (vertices_left_ > 0) {
    --vertices_left_;
    return item.command == command_ && item.param1 == vertices_;
  }
  if (is_circle(item.command))
    return item.param1 > 0 && std::isfinite(item.param1);
  if (!is_vertex(item.command))
    return true;
  const bool is_number = item.param1 >= min_vertices && item.param1 <= left && std::floor(item.param1) == item.param1;
  if (!is_number)
    return false;
  command_ = item.command;
  vertices_ = item.param1;
  vertices_left_ = static_cast<int>(item.param1) - 1;
  return true;
}

} // namespace godwit::ground_port::mission_server
