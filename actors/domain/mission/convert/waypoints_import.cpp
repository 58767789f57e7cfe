#include "actors/domain/mission/convert/waypoints_import.hpp"

#include <span>
#include <utility>
#include <vector>

#include "actors/domain/mission/convert/item_import.hpp"
#include "actors/domain/mission/convert/item_list_import.hpp"
#include "io/mavlink/waypoint_file/coordinate_text.hpp"
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

} // namespace

import_result import_waypoints(std::string_view text, const import_options& options) {
  const auto lines = io::mavlink::read_waypoints(text);
  if (!lines)
    return tl::unexpected(conversion_error{error_of(lines.error(), text), {}});
  std::vector<vehicle_item> all;
  all.reserve(lines->size());
  for (const auto& each : *lines)
    all.push_back(vehicle_item_of(each));
  std::span<const vehicle_item> items = all;
  loss_list losses;
  document mission;
  mission.mission_id = options.mission_id.value_or(uuid_of_text(text));
  if (!items.empty() && is_home(items.front())) {
    const auto& home = items.front();
    mission.planned_home = home_at(home.latitude(), home.longitude(), home.altitude_m());
    items = items.subspan(1);
  }
  item_importer importer(context_of(mission.planned_home, false), losses);
  for (const auto& each : items)
    importer.take(each);
  mission.items = std::move(importer.items());
  return finished(mission, std::move(losses), options, text);
}

} // namespace godwit::mission
