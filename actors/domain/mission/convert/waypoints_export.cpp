#include "actors/domain/mission/convert/waypoints_export.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include "actors/domain/geofence/fence_name.hpp"
#include "actors/domain/mission/convert/item_export.hpp"
#include "io/mavlink/enums.hpp"
#include "io/mavlink/frame_meaning.hpp"
#include "io/mavlink/waypoint_file/waypoint_file.hpp"
#include "runtime/assert.hpp"

namespace godwit::mission {

namespace {

using io::mavlink::mission_item_int;

std::int32_t scaled(double degrees) { return static_cast<std::int32_t>(std::lround(degrees * 1e7)); }

// What is not given is 0.
std::int32_t whole(double value) { return std::isfinite(value) ? static_cast<std::int32_t>(std::lround(value)) : 0; }

// HOME stands in where an item has no place: x and y of a line are whole numbers, which can not be "not given".
mission_item_int line_of(const vehicle_item& each, const planned_home& home) {
  mission_item_int line;
  line.frame = each.frame;
  line.command = each.command;
  line.autocontinue = each.autocontinue ? 1 : 0;
  line.param1 = static_cast<float>(each.param(1));
  line.param2 = static_cast<float>(each.param(2));
  line.param3 = static_cast<float>(each.param(3));
  line.param4 = static_cast<float>(each.param(4));
  line.z = static_cast<float>(each.altitude_m());
  if (io::mavlink::coordinates_of(each.frame) != io::mavlink::coordinate_kind::global) {
    line.x = whole(each.latitude());
    line.y = whole(each.longitude());
    return line;
  }
  line.x = scaled(std::isfinite(each.latitude()) ? each.latitude() : home.latitude);
  line.y = scaled(std::isfinite(each.longitude()) ? each.longitude() : home.longitude);
  return line;
}

mission_item_int line_at(io::mavlink::mav_cmd command, double latitude, double longitude) {
  mission_item_int line;
  line.frame = frame::global;
  line.command = io::mavlink::number(command);
  line.autocontinue = 1;
  line.x = scaled(latitude);
  line.y = scaled(longitude);
  return line;
}

// A file of lines holds one kind of plan: the fence, where there is nothing else.
void append_fence(std::vector<mission_item_int>& lines, const geofence& from) {
  constexpr auto inclusion = io::mavlink::mav_cmd::nav_fence_polygon_vertex_inclusion;
  constexpr auto exclusion = io::mavlink::mav_cmd::nav_fence_polygon_vertex_exclusion;
  if (from.circle) {
    constexpr auto within = io::mavlink::mav_cmd::nav_fence_circle_inclusion;
    constexpr auto around = io::mavlink::mav_cmd::nav_fence_circle_exclusion;
    const auto& centre = *from.circle;
    lines.push_back(line_at(from.kind == fence_kind::inclusion ? within : around, centre.latitude, centre.longitude));
    lines.back().param1 = static_cast<float>(centre.radius_m);
    return;
  }
  for (const auto& corner : from.vertices) {
    lines.push_back(
        line_at(from.kind == fence_kind::inclusion ? inclusion : exclusion, corner.latitude, corner.longitude));
    lines.back().param1 = static_cast<float>(from.vertices.size());
  }
}

exported written(std::vector<mission_item_int> lines, loss_list losses) {
  for (std::size_t i = 0; i < lines.size(); ++i)
    lines[i].seq = static_cast<std::uint16_t>(i);
  auto text = io::mavlink::write_waypoints(lines);
  GODWIT_ASSERT(text.has_value(), "a mission that keeps the rules can be written as lines");
  return {std::move(*text), std::move(losses)};
}

exported export_fence(const document& mission) {
  std::vector<mission_item_int> lines;
  loss_list losses;
  if (const auto& back = mission.breach_return_point) {
    lines.push_back(line_at(io::mavlink::mav_cmd::nav_fence_return_point, back->latitude, back->longitude));
    lines.back().z = static_cast<float>(back->altitude_m);
  }
  for (std::size_t i = 0; i < mission.geofences.size(); ++i) {
    const auto& each = mission.geofences[i];
    append_fence(lines, each);
    if (each.floor_m || each.ceiling_m)
      losses.add({{},
                  godwit::geofence::fence_name(i) + ": floor and ceiling",
                  "the fences of lines have no heights",
                  "left out"});
  }
  if (mission.rally_points)
    losses.add({{}, "the rally points", "a file of lines holds one kind of plan", "left out"});
  return written(std::move(lines), std::move(losses));
}

exported export_rally_points(const document& mission) {
  std::vector<mission_item_int> lines;
  for (const auto& each : *mission.rally_points) {
    lines.push_back(line_at(io::mavlink::mav_cmd::nav_rally_point, each.latitude, each.longitude));
    lines.back().frame = frame::global_relative;
    lines.back().z = static_cast<float>(each.altitude_m);
  }
  return written(std::move(lines), {});
}

} // namespace

exported export_waypoints(const document& mission) {
  if (mission.items.empty() && mission.geofences.empty() && mission.rally_points)
    return export_rally_points(mission);
  if (mission.items.empty())
    return export_fence(mission);
  exported result;
  const auto home = home_to_write(mission);
  std::vector<mission_item_int> lines{line_of(
      {0, command::waypoint, frame::global, {0, 0, 0, 0, home.latitude, home.longitude, home.above_sea_m.value_or(0)}},
      home)};
  if (mission.return_point && mission.return_point->altitude_m != 0)
    result.losses.add({{}, "return point: height", "a home position is on the ground", "left out"});
  add_place_losses(mission.items, result.losses);
  const auto made = numbered_items_of(mission, lines.size(), false);
  for (std::size_t i = 0; i < mission.items.size(); ++i) {
    if (std::holds_alternative<survey>(mission.items[i]))
      result.losses.add({i, "the survey", "a file of lines has no patterns", "left out"});
    const bool is_verbatim = std::holds_alternative<command_item>(mission.items[i]);
    for (const auto& each : made[i])
      lines.push_back(line_of(each, is_verbatim ? planned_home{} : home));
  }
  for (std::size_t i = 0; i < mission.geofences.size(); ++i)
    result.losses.add({{}, godwit::geofence::fence_name(i), "a file of lines has no fences", "left out"});
  if (mission.rally_points || mission.breach_return_point)
    result.losses.add(
        {{}, "rally points and the point of return of the fence", "a file of lines has none", "left out"});
  return written(std::move(lines), std::move(result.losses));
}

} // namespace godwit::mission
