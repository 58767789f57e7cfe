#include "actors/executor/plan/fence_items.hpp"

#include <algorithm>
#include <cmath>

#include "io/mavlink/enums.hpp"
#include "io/mavlink/frame_meaning.hpp"

namespace godwit::executor::plan {
namespace {

using io::mavlink::mav_cmd;
using io::mavlink::mission_item_int;
using io::mavlink::number;
using mission::fence_kind;

bool has_altitudes(const mission::geofence& each) { return each.floor_m || each.ceiling_m; }

mission_item_int item_at(std::size_t sequence, mav_cmd command, double latitude, double longitude) {
  constexpr double units = io::mavlink::units_of(io::mavlink::coordinate_kind::global);
  mission_item_int item;
  item.seq = static_cast<std::uint16_t>(sequence);
  item.frame = number(io::mavlink::mav_frame::global);
  item.command = number(command);
  item.autocontinue = 1;
  item.x = static_cast<std::int32_t>(std::lround(latitude * units));
  item.y = static_cast<std::int32_t>(std::lround(longitude * units));
  return item;
}

void append(std::vector<mission_item_int>& to, const mission::geofence& fence) {
  if (const auto& circle = fence.circle) {
    const auto within =
        fence.kind == fence_kind::inclusion ? mav_cmd::nav_fence_circle_inclusion : mav_cmd::nav_fence_circle_exclusion;
    to.push_back(item_at(to.size(), within, circle->latitude, circle->longitude));
    to.back().param1 = static_cast<float>(circle->radius_m);
    return;
  }
  const auto command = fence.kind == fence_kind::inclusion ? mav_cmd::nav_fence_polygon_vertex_inclusion
                                                           : mav_cmd::nav_fence_polygon_vertex_exclusion;
  for (const auto& corner : fence.vertices) {
    to.push_back(item_at(to.size(), command, corner.latitude, corner.longitude));
    to.back().param1 = static_cast<float>(fence.vertices.size());
  }
}

} // namespace

fence_list fence_items(const std::vector<mission::geofence>& fences) {
  fence_list result;
  const bool has_several = std::ranges::count(fences, fence_kind::inclusion, &mission::geofence::kind) > 1;
  bool has_block_of_air = false;
  for (const auto& each : fences) {
    const bool is_inclusion = each.kind == fence_kind::inclusion;
    const bool is_block = !is_inclusion && has_altitudes(each);
    has_block_of_air = has_block_of_air || is_block;
    if (!is_block && !(is_inclusion && has_several))
      append(result.items, each);
  }
  if (has_several)
    result.left_out.emplace_back(
        "by its own fence the vehicle would have to be inside of all inclusion fences at once");
  if (has_block_of_air)
    result.left_out.emplace_back("an exclusion fence with a floor or a ceiling would be one for all altitudes there");
  return result;
}

std::vector<mission_item_int> rally_items(const mission::document& mission) {
  std::vector<mission_item_int> result;
  if (mission.rally_points)
    for (const auto& each : *mission.rally_points) {
      result.push_back(item_at(result.size(), mav_cmd::nav_rally_point, each.latitude, each.longitude));
      result.back().frame = number(io::mavlink::mav_frame::global_relative_alt);
      result.back().z = static_cast<float>(each.altitude_m);
    }
  return result;
}

void append_return_point(fence_list& to, const mission::document& mission) {
  const auto& back = mission.breach_return_point;
  if (!back || to.items.empty())
    return;
  to.items.push_back(item_at(to.items.size(), mav_cmd::nav_fence_return_point, back->latitude, back->longitude));
} // without a height, which vehicles do not keep

} // namespace godwit::executor::plan
