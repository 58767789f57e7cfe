#include "actors/domain/mission/convert/plan_import.hpp"

#include <optional>
#include <utility>

#include "actors/domain/mission/convert/fence_import.hpp"
#include "actors/domain/mission/convert/plan_patterns.hpp"
#include "actors/domain/mission/convert/plan_source.hpp"
#include "actors/domain/mission/convert/plan_vehicle.hpp"
#include "actors/domain/mission/json_document.hpp"

namespace godwit::mission {

namespace {

constexpr std::int64_t plan_version = 1;
constexpr std::int64_t first_mission_version = 1; // items with param1 to param4
constexpr std::int64_t last_mission_version = 2;

// What QGroundControl wrote into `.mission` files before it had plans.
bool is_mission_file(const plan_node& root) {
  return !root.has("fileType") && root.has("items") && root.has("plannedHomePosition");
}

// Whether the rest can be read at all.
bool is_plan(plan_source& source, const plan_node& root) {
  if (source.text(root, "fileType") != "Plan")
    source.wrong({root.value, "/fileType"}, "is not \"Plan\"", "a plan of QGroundControl");
  else if (const auto version = source.integer(root, "version"); version != plan_version)
    source.wrong({root.value, "/version"}, "is " + std::to_string(version), std::to_string(plan_version));
  else if (const auto inner = source.object(root, "mission"); source.problems.empty())
    if (const auto number = source.integer(inner, "version");
        number < first_mission_version || number > last_mission_version)
      source.wrong({root.value, "/mission/version"}, "is " + std::to_string(number), "1 or 2");
  return source.problems.empty();
}

void import_items(plan_source& source, const plan_node& mission, item_importer& importer) {
  const auto items = source.list(mission, "items");
  for (std::size_t i = 0; i < items.size() && importer.items().size() < max_plan_items; ++i) {
    auto node = items[i];
    node.item = i;
    const auto type = source.text(node, "type");
    if (type == "SimpleItem" || type == "missionItem") {
      if (const auto simple = read_simple_item(source, node))
        importer.take(*simple);
    } else if (type == "ComplexItem") {
      import_pattern(source, node, importer);
    } else {
      source.wrong(node, "has the type " + in_quotes(type), "\"SimpleItem\" or \"ComplexItem\"");
    }
  }
}

struct plan_parts {
  document mission;
  source_map places;
  std::optional<vehicle_profile> vehicle;
};

// MISSION has the items and the planned home; FIRMWARE is the key of what they are for.
void import_mission(plan_source& source, const plan_node& mission, std::string_view firmware,
                    const import_options& options, plan_parts& result) {
  const auto place = source.place(mission, "plannedHomePosition");
  result.mission.planned_home = home_at(place[0], place[1], place[2]);
  const auto autopilot = source.integer(mission, firmware);
  const auto type = mission.has("vehicleType") ? source.integer(mission, "vehicleType") : 0;
  result.vehicle = options.vehicle ? options.vehicle : profile_of({autopilot, type});
  item_importer importer(context_of(autopilot == px4_firmware, result.vehicle, options.allowed), source.losses);
  import_items(source, mission, importer);
  importer.resolve_jumps();
  result.mission.items = std::move(importer.items());
  result.places.items = std::move(importer.places());
  result.places.list = pointer_to(mission.pointer, "items");
  result.places.holds_items = mission.has("items") && !(*mission.value)["items"].empty();
}

plan_parts import_root(plan_source& source, const plan_node& root, const import_options& options) {
  const auto mission = source.object(root, "mission");
  source.lose_unknown(mission, {"cruiseSpeed", "firmwareType", "globalPlanAltitudeMode", "hoverSpeed", "items",
                                "plannedHomePosition", "vehicleType", "version"});
  plan_parts result;
  import_mission(source, mission, "firmwareType", options, result);
  if (root.has("geoFence")) {
    auto fences = import_fence(source, source.object(root, "geoFence"));
    result.mission.geofences = std::move(fences.all);
    result.places.geofences = std::move(fences.places);
    result.mission.breach_return_point = fences.breach_return_point;
  }
  if (root.has("rallyPoints"))
    result.mission.rally_points = import_rally_points(source, source.object(root, "rallyPoints"));
  return result;
}

// Home may be an item there, or a place.
plan_parts import_mission_file(plan_source& source, const plan_node& root, const import_options& options) {
  source.lose_unknown(root, {"MAV_AUTOPILOT", "complexItems", "firmwareType", "groundStation", "items",
                             "plannedHomePosition", "vehicleType", "version"});
  if (root.has("complexItems"))
    for (const auto& each : source.list(root, "complexItems"))
      source.losses.add({{}, "the pattern " + in_quotes(each.pointer), "its form is not known", "left out"});
  plan_parts result;
  auto flat = *root.value;
  if (const auto& home = flat["plannedHomePosition"]; home.is_object() && home.contains("coordinate"))
    flat["plannedHomePosition"] = nlohmann::json(home["coordinate"]);
  const auto* const firmware = root.has("MAV_AUTOPILOT") ? "MAV_AUTOPILOT" : "firmwareType";
  import_mission(source, {&flat, root.pointer}, firmware, options, result);
  return result;
}

} // namespace

import_result import_plan(std::string_view text, const import_options& options) {
  const auto parsed = parse_document(text, max_plan_bytes);
  if (!parsed)
    return tl::unexpected(conversion_error{parsed.error(), {}});
  loss_list losses;
  plan_source source(losses, options.keeps_unknown);
  const plan_node root{&*parsed, {}};
  plan_parts found;
  if (is_mission_file(root))
    found = import_mission_file(source, root, options);
  else if (is_plan(source, root))
    found = import_root(source, root, options);
  if (!source.problems.empty())
    return tl::unexpected(
        conversion_error{bounded({document_errc::wrong_form, std::move(source.problems)}, text), std::move(losses)});
  found.mission.mission_id = options.mission_id.value_or(uuid_of_text(text));
  found.mission.vehicle = found.vehicle;
  return finished(found.mission, std::move(losses), options, text, found.places);
}

} // namespace godwit::mission
