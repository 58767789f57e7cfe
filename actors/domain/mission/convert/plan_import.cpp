#include "actors/domain/mission/convert/plan_import.hpp"

#include <utility>

#include "actors/domain/mission/convert/fence_import.hpp"
#include "actors/domain/mission/convert/plan_patterns.hpp"
#include "actors/domain/mission/convert/plan_source.hpp"
#include "actors/domain/mission/json_document.hpp"

namespace godwit::mission {

namespace {

constexpr std::int64_t plan_version = 1;
constexpr std::int64_t mission_version = 2;
constexpr std::int64_t px4_firmware = 12; // MAV_AUTOPILOT

// What QGroundControl wrote into `.mission` files before it had plans.
bool is_older_than_plans(const plan_node& root) {
  return !root.has("fileType") && root.has("items") && root.has("plannedHomePosition");
}

// Whether the rest can be read at all.
bool is_plan(plan_source& source, const plan_node& root) {
  if (is_older_than_plans(root))
    source.wrong(root, "is a mission file of an older QGroundControl", "a plan: open it there and save it again");
  else if (source.text(root, "fileType") != "Plan")
    source.wrong({root.value, "/fileType"}, "is not \"Plan\"", "a plan of QGroundControl");
  else if (const auto version = source.integer(root, "version"); version != plan_version)
    source.wrong({root.value, "/version"}, "is " + std::to_string(version), std::to_string(plan_version));
  else if (const auto inner = source.object(root, "mission"); source.problems.empty())
    if (const auto number = source.integer(inner, "version"); number != mission_version)
      source.wrong({root.value, "/mission/version"}, "is " + std::to_string(number), std::to_string(mission_version));
  return source.problems.empty();
}

void import_items(plan_source& source, const plan_node& mission, item_importer& importer) {
  const auto items = source.list(mission, "items");
  for (std::size_t i = 0; i < items.size() && importer.items().size() < max_plan_items; ++i) {
    auto node = items[i];
    node.item = i;
    const auto type = source.text(node, "type");
    if (type == "SimpleItem") {
      if (const auto simple = read_simple_item(source, node))
        importer.take(*simple);
    } else if (type == "ComplexItem") {
      import_pattern(source, node, importer);
    } else {
      source.wrong(node, "has the type " + in_quotes(type), "\"SimpleItem\" or \"ComplexItem\"");
    }
  }
}

document import_root(plan_source& source, const plan_node& root) {
  source.lose_unknown(root, {"fileType", "geoFence", "groundStation", "mission", "rallyPoints", "version"});
  const auto mission = source.object(root, "mission");
  source.lose_unknown(mission, {"cruiseSpeed", "firmwareType", "globalPlanAltitudeMode", "hoverSpeed", "items",
                                "plannedHomePosition", "vehicleType", "version"});
  const auto place = source.place(mission, "plannedHomePosition");
  document result;
  result.planned_home = home_at(place[0], place[1], place[2]);
  const bool is_for_px4 = source.integer(mission, "firmwareType") == px4_firmware;
  item_importer importer(context_of(result.planned_home, is_for_px4), source.losses);
  import_items(source, mission, importer);
  result.items = std::move(importer.items());
  if (root.has("geoFence"))
    result.geofences = import_fence(source, source.object(root, "geoFence"));
  if (root.has("rallyPoints"))
    import_rally_points(source, source.object(root, "rallyPoints"));
  return result;
}

} // namespace

import_result import_plan(std::string_view text, const import_options& options) {
  const auto parsed = parse_document(text, max_plan_bytes);
  if (!parsed)
    return tl::unexpected(conversion_error{parsed.error(), {}});
  loss_list losses;
  plan_source source(losses);
  const plan_node root{&*parsed, {}};
  document mission;
  if (is_plan(source, root))
    mission = import_root(source, root);
  if (!source.problems.empty())
    return tl::unexpected(
        conversion_error{bounded({document_errc::wrong_form, std::move(source.problems)}, text), std::move(losses)});
  mission.mission_id = options.mission_id.value_or(uuid_of_text(text));
  return finished(mission, std::move(losses), options, text);
}

} // namespace godwit::mission
