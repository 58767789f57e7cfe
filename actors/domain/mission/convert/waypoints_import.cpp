#include "actors/domain/mission/convert/waypoints_import.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "actors/domain/mission/convert/fence_import.hpp"
#include "actors/domain/mission/convert/item_import.hpp"
#include "actors/domain/mission/convert/item_list_import.hpp"
#include "io/mavlink/enums.hpp"
#include "io/mavlink/frame_meaning.hpp"
#include "io/mavlink/waypoint_file/fence_rally_reader.hpp"
#include "io/mavlink/waypoint_file/format.hpp"
#include "io/mavlink/waypoint_file/waypoint_reader.hpp"

namespace godwit::mission {

namespace {

// Some planners write an acceptance radius into it.
bool is_home(const vehicle_item& first) {
  const auto none = [&](std::size_t from_1) { return !(std::abs(first.param(from_1)) > 0); };
  return first.command == command::waypoint && (first.frame == frame::global || first.frame == frame::global_int) &&
         none(1) && none(3) && none(4);
}

document_error error_of(const io::mavlink::waypoint_error& found, std::string_view text) {
  const bool is_too_large = found.code == io::mavlink::waypoint_errc::too_large;
  const auto place = found.line == 0 ? std::string() : "line " + std::to_string(found.line);
  const auto column = found.column.empty() ? std::string() : found.column + ": ";
  return bounded({is_too_large ? document_errc::too_large : document_errc::syntax, {{place, column + found.what, {}}}},
                 text);
}

using io::mavlink::mav_cmd;
using io::mavlink::mav_mission_type;
using io::mavlink::plan_lines;

// A first item of command 0 is home to MAVProxy; Mission Planner has written such ones.
vehicle_item vehicle_item_at(const plan_lines& lines, std::size_t index) {
  auto result = vehicle_item_of(lines.items[index]);
  result.place = "line " + std::to_string(lines.lines[index]);
  if (index == 0 && result.command == 0)
    result.command = command::waypoint;
  return result;
}

bool is_rally_point(const io::mavlink::mission_item_int& each) {
  return each.command == io::mavlink::number(mav_cmd::nav_rally_point);
}

bool is_of_fence(const io::mavlink::mission_item_int& each) {
  return each.command >= io::mavlink::number(mav_cmd::nav_fence_return_point) &&
         each.command <= io::mavlink::number(mav_cmd::nav_fence_circle_exclusion);
}

tl::unexpected<conversion_error> failed(std::string place, std::string what, std::string_view text) {
  return tl::unexpected(
      conversion_error{bounded({document_errc::wrong_form, {{std::move(place), std::move(what), {}}}}, text), {}});
}

bool is_return_point(const io::mavlink::mission_item_int& each) {
  return each.command == io::mavlink::number(mav_cmd::nav_fence_return_point);
}

position place_of_line(const io::mavlink::mission_item_int& each) {
  const auto item = vehicle_item_of(each);
  return {item.latitude(), item.longitude(), item.altitude_m()};
}

// Heights above home, as their vehicles read them.
import_result import_rally_file(const plan_lines& lines, const import_options& options, std::string_view text) {
  loss_list losses;
  document mission;
  mission.mission_id = options.mission_id.value_or(uuid_of_text(text));
  mission.rally_points.emplace();
  for (std::size_t i = 0; i < lines.items.size(); ++i) {
    const auto& each = lines.items[i];
    if (io::mavlink::altitude_in(each.frame) != io::mavlink::altitude_kind::above_home)
      losses.add({i, "rally point in frame " + std::to_string(each.frame), "rally points of a mission are above home",
                  "taken as above home", "line " + std::to_string(lines.lines[i])});
    mission.rally_points->push_back(place_of_line(each));
  }
  return finished(mission, std::move(losses), options, text);
}

import_result import_fence_file(const plan_lines& lines, const import_options& options, std::string_view text) {
  auto fence = import_fence_list(lines.items);
  if (!fence)
    return failed({}, "holds a fence, and " + fence.error(), text);
  document mission;
  mission.mission_id = options.mission_id.value_or(uuid_of_text(text));
  mission.geofences = std::move(fence->geofences);
  mission.breach_return_point = fence->breach_return_point;
  source_map places;
  std::size_t first = 0;
  for (const auto& each : mission.geofences) {
    while (is_return_point(lines.items.at(first)))
      ++first;
    places.geofences.push_back({"line " + std::to_string(lines.lines.at(first)), {}});
    first += each.circle ? 1 : each.vertices.size();
  }
  return finished(mission, {}, options, text, places);
}

import_result import_item_lines(const plan_lines& lines, const import_options& options, std::string_view text) {
  loss_list losses;
  document mission;
  mission.mission_id = options.mission_id.value_or(uuid_of_text(text));
  std::size_t first = 0;
  if (!lines.items.empty())
    if (const auto home = vehicle_item_at(lines, 0); is_home(home)) {
      mission.planned_home = home_at(home.latitude(), home.longitude(), home.altitude_m());
      first = 1;
    }
  item_importer importer(context_of(false, options.vehicle, options.allowed), losses);
  for (auto i = first; i < lines.items.size(); ++i)
    importer.take(vehicle_item_at(lines, i));
  importer.resolve_jumps();
  mission.items = std::move(importer.items());
  mission.vehicle = options.vehicle;
  const source_map places{std::move(importer.places()), {}, {}, lines.items.size() > first};
  return finished(mission, std::move(losses), options, text, places);
}

} // namespace

import_result import_waypoints(std::string_view text, const import_options& options) {
  const auto holds = io::mavlink::fence_or_rally(text);
  auto lines = holds == mav_mission_type::rally ? io::mavlink::read_rally_lines(text)
               : holds                          ? io::mavlink::read_fence_lines(text)
                                                : io::mavlink::read_plan_lines(text);
  if (!lines)
    return tl::unexpected(conversion_error{error_of(lines.error(), text), {}});
  if (!lines->items.empty() && std::ranges::all_of(lines->items, is_rally_point))
    return import_rally_file(*lines, options, text);
  if (!lines->items.empty() && std::ranges::all_of(lines->items, is_of_fence))
    return import_fence_file(*lines, options, text);
  return import_item_lines(*lines, options, text);
}

} // namespace godwit::mission
