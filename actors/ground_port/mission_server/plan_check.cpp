#include "actors/ground_port/mission_server/plan_check.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "actors/domain/mission/commands/command_table.hpp"

namespace godwit::ground_port::mission_server {

namespace {

using mavlink::mav_frame;
using mavlink::mav_mission_result;
using mavlink::mav_mission_type;
using mavlink::number;

constexpr std::int32_t max_latitude = 900'000'000; // 1e-7 degrees
constexpr std::int32_t max_longitude = 1'800'000'000;

} // namespace

mav_mission_result check_item(const mavlink::mission_item_int& item, const server_profile& vehicle) {
  const auto type = static_cast<mav_mission_type>(item.mission_type);
  const auto* const row = mission::command_of(item.command);
  const bool is_allowed = row == nullptr && type == mav_mission_type::mission &&
                          std::ranges::find(vehicle.also_takes, item.command) != vehicle.also_takes.end();
  const auto place = is_allowed ? std::optional(item_place::at_a_position) : place_of(item.command, type);
  const bool is_refused =
      vehicle.profile && row != nullptr && row->answer_of(*vehicle.profile) == mission::item_answer::refused;
  if (!place || is_refused)
    return mav_mission_result::unsupported;
  if (io::name_of(static_cast<mav_frame>(item.frame)).empty())
    return mav_mission_result::unsupported_frame;
  const bool is_somewhere = *place == item_place::at_a_position && item.frame != number(mav_frame::mission);
  if (!vehicle.checks_latitude || !is_somewhere)
    return mav_mission_result::accepted;
  if (std::abs(std::int64_t{item.x}) > max_latitude)
    return mav_mission_result::invalid_param5_x;
  if (std::abs(std::int64_t{item.y}) > max_longitude)
    return mav_mission_result::invalid_param6_y;
  return mav_mission_result::accepted;
}

namespace {

using mission::command_class;

bool is_of(const mission::command_row& row, mav_mission_type type) {
  if (type == mav_mission_type::fence || type == mav_mission_type::rally)
    return row.kind == (type == mav_mission_type::fence ? command_class::fence : command_class::rally);
  return row.is_taken_by_anyone() && row.kind != command_class::fence && row.kind != command_class::rally &&
         row.kind != command_class::never;
}

} // namespace

std::optional<item_place> place_of(std::uint16_t command, mav_mission_type type) {
  const auto* const row = mission::command_of(command);
  if (row == nullptr || !is_of(*row, type))
    return std::nullopt;
  return row->has_place ? item_place::at_a_position : item_place::anywhere;
}

namespace {

using mavlink::mav_cmd;

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
