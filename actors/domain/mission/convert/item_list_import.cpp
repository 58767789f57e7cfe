#include "actors/domain/mission/convert/item_list_import.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "actors/domain/mission/convert/fence_import.hpp"
#include "actors/domain/mission/convert/item_import.hpp"
#include "io/mavlink/enums.hpp"
#include "io/mavlink/frame_meaning.hpp"

namespace godwit::mission {

namespace {

using io::mavlink::mav_cmd;
using io::mavlink::mission_item_int;
using io::mavlink::number;

using io::mavlink::units_a_degree;
constexpr float least_corners = 3;

bool is_corner(const mission_item_int& each) {
  return each.command == number(mav_cmd::nav_fence_polygon_vertex_inclusion) ||
         each.command == number(mav_cmd::nav_fence_polygon_vertex_exclusion);
}

bool is_circle(const mission_item_int& each) {
  return each.command == number(mav_cmd::nav_fence_circle_inclusion) ||
         each.command == number(mav_cmd::nav_fence_circle_exclusion);
}

fence_kind kind_of(const mission_item_int& each) {
  const bool lets_in = each.command == number(mav_cmd::nav_fence_polygon_vertex_inclusion) ||
                       each.command == number(mav_cmd::nav_fence_circle_inclusion);
  return lets_in ? fence_kind::inclusion : fence_kind::exclusion;
}

vertex place_of(const mission_item_int& each) { return {each.x / units_a_degree, each.y / units_a_degree}; }

std::string source_text(std::span<const vehicle_item> items) {
  return "an upload of " + std::to_string(items.size()) + " items";
}

} // namespace

vehicle_item vehicle_item_of(const mission_item_int& each) {
  const bool is_on_earth = io::mavlink::coordinates_of(each.frame) == io::mavlink::coordinate_kind::global;
  const auto scale = is_on_earth ? units_a_degree : 1;
  constexpr auto unset = std::numeric_limits<std::int32_t>::max();
  const auto coordinate = [&](std::int32_t value) { return value == unset ? not_given : value / scale; };
  return {each.seq,
          each.command,
          each.frame,
          {each.param1, each.param2, each.param3, each.param4, coordinate(each.x), coordinate(each.y), each.z},
          each.autocontinue != 0};
}

tl::expected<imported_list, conversion_error> import_item_list(std::span<const mission_item_int> uploaded,
                                                               const item_list_options& options) {
  std::vector<vehicle_item> items;
  items.reserve(uploaded.size());
  for (const auto& each : uploaded)
    items.emplace_back(vehicle_item_of(each)).place = "the upload";
  loss_list losses;
  imported_list result;
  const bool is_for_px4 = options.vehicle && is_px4(*options.vehicle);
  item_importer importer({is_for_px4, options.vehicle, options.allowed}, losses);
  for (const auto& each : items)
    importer.take(each);
  importer.resolve_jumps();
  for (const auto number : importer.numbers())
    result.places.push_back(static_cast<std::uint16_t>(number));
  document mission;
  mission.mission_id = options.mission_id;
  mission.items = std::move(importer.items());
  mission.geofences = options.fence.geofences;
  mission.breach_return_point = options.fence.breach_return_point;
  const source_map places{std::move(importer.places()), {}, {}, !items.empty()};
  auto checked = finished(mission, std::move(losses), {options.allow_partial, {}}, source_text(items), places);
  if (!checked)
    return tl::unexpected(std::move(checked.error()));
  result.mission = std::move(checked->mission);
  result.losses = std::move(checked->losses);
  return result;
}

tl::expected<imported_fence_list, std::string> import_fence_list(std::span<const mission_item_int> items) {
  imported_fence_list result;
  for (std::size_t i = 0; i < items.size();) {
    const auto& first = items[i];
    if (first.command == io::mavlink::number(io::mavlink::mav_cmd::nav_fence_return_point)) {
      const auto point = vehicle_item_of(first);
      result.breach_return_point =
          position{point.latitude(), point.longitude(), std::isfinite(point.altitude_m()) ? point.altitude_m() : 0};
      ++i;
      continue;
    }
    const auto where = "item " + std::to_string(first.seq) + " of the fence ";
    geofence next{kind_of(first), {}, {}, {}};
    if (is_circle(first)) {
      auto corners = polygon_of_circle(place_of(first), first.param1, next.kind);
      if (!corners)
        return tl::unexpected(where + "is a circle of " + number_text(first.param1) +
                              " m, of which no polygon is made");
      next.vertices = *std::move(corners);
      const auto centre = place_of(first);
      next.circle = fence_circle{centre.latitude, centre.longitude, static_cast<double>(first.param1)};
      ++i;
    } else if (is_corner(first)) {
      const bool is_whole = first.param1 >= least_corners && first.param1 <= static_cast<float>(items.size() - i);
      if (!is_whole)
        return tl::unexpected(where + "begins a polygon of " + number_text(first.param1) + " corners");
      for (const auto end = i + static_cast<std::size_t>(first.param1); i < end; ++i) {
        if (items[i].command != first.command)
          return tl::unexpected(where + "begins a polygon that is not complete");
        next.vertices.push_back(place_of(items[i]));
      }
    } else {
      return tl::unexpected(where + "is neither a corner nor a circle (" + command_name(first.command) + ")");
    }
    result.geofences.push_back(std::move(next));
  }
  return result;
}

} // namespace godwit::mission
