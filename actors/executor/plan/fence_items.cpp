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

void append(std::vector<mission_item_int>& to, const mission::geofence& fence) {
  constexpr double units = io::mavlink::units_of(io::mavlink::coordinate_kind::global);
  const auto command = fence.kind == fence_kind::inclusion ? mav_cmd::nav_fence_polygon_vertex_inclusion
                                                           : mav_cmd::nav_fence_polygon_vertex_exclusion;
  for (const auto& corner : fence.vertices) {
    mission_item_int item;
    item.seq = static_cast<std::uint16_t>(to.size());
    item.frame = number(io::mavlink::mav_frame::global);
    item.command = number(command);
    item.autocontinue = 1;
    item.param1 = static_cast<float>(fence.vertices.size());
    item.x = static_cast<std::int32_t>(std::lround(corner.latitude * units));
    item.y = static_cast<std::int32_t>(std::lround(corner.longitude * units));
    to.push_back(item);
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

} // namespace godwit::executor::plan
