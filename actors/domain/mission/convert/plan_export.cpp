#include "actors/domain/mission/convert/plan_export.hpp"

#include <cmath>

#include <nlohmann/json.hpp>

#include "actors/domain/geofence/fence_name.hpp"
#include "actors/domain/mission/convert/item_export.hpp"

namespace godwit::mission {

namespace {

using nlohmann::json;

constexpr int px4 = 12;         // MAV_AUTOPILOT: there a yaw of NaN is "leave it", which is what we mean
constexpr int multirotor = 2;   // MAV_TYPE
constexpr int above_home = 1;   // QGroundControl's AltitudeMode
constexpr double usual_mps = 5; // only for the ground station's estimate of the time

json simple_item(const vehicle_item& each, std::size_t number) {
  auto params = json::array();
  for (const auto value : each.params)
    params.push_back(std::isfinite(value) ? json(value) : json());
  json result{{"type", "SimpleItem"}, {"autoContinue", true}, {"command", each.command},
              {"doJumpId", number},   {"frame", each.frame},  {"params", std::move(params)}};
  if (each.frame == frame::global_relative) {
    result["AMSLAltAboveTerrain"] = nullptr;
    result["Altitude"] = each.altitude_m();
    result["AltitudeMode"] = above_home;
  }
  return result;
}

json pairs_of(const std::vector<vertex>& corners) {
  auto result = json::array();
  for (const auto& each : corners)
    result.push_back(json::array({each.latitude, each.longitude}));
  return result;
}

json survey_pattern(const survey& each) {
  const json camera{{"AdjustedFootprintFrontal", each.line_spacing_m},
                    {"AdjustedFootprintSide", each.line_spacing_m},
                    {"CameraName", "Manual (no camera specs)"},
                    {"DistanceMode", above_home},
                    {"DistanceToSurface", each.altitude_m},
                    {"version", 2}};
  const json transects{{"CameraCalc", camera},
                       {"CameraShots", 0},
                       {"CameraTriggerInTurnAround", false},
                       {"FollowTerrain", false},
                       {"HoverAndCapture", false},
                       {"Items", json::array()},
                       {"Refly90Degrees", false},
                       {"TurnAroundDistance", 0},
                       {"VisualTransectPoints", json::array()},
                       {"version", 2}};
  return {{"TransectStyleComplexItem", transects},
          {"angle", each.heading_deg.value_or(0)},
          {"complexItemType", "survey"},
          {"entryLocation", 0},
          {"flyAlternateTransects", false},
          {"polygon", pairs_of(each.polygon)},
          {"splitConcavePolygons", false},
          {"type", "ComplexItem"},
          {"version", 5}};
}

json fence_of(const document& mission, loss_list& losses) {
  auto polygons = json::array();
  for (std::size_t i = 0; i < mission.geofences.size(); ++i) {
    const auto& each = mission.geofences[i];
    if (each.floor_m || each.ceiling_m)
      losses.add({{},
                  godwit::geofence::fence_name(i) + ": floor and ceiling",
                  "the fences of a plan have no heights",
                  "left out"});
    polygons.push_back(
        {{"inclusion", each.kind == fence_kind::inclusion}, {"polygon", pairs_of(each.vertices)}, {"version", 1}});
  }
  return {{"circles", json::array()}, {"polygons", std::move(polygons)}, {"version", 2}};
}

json items_of(const document& mission) {
  auto items = json::array();
  for (const auto& each : mission.items) {
    if (const auto* area = std::get_if<survey>(&each))
      items.push_back(survey_pattern(*area));
    for (const auto& simple : vehicle_items_of(each))
      items.push_back(simple_item(simple, items.size() + 1));
  }
  return items;
}

} // namespace

exported export_plan(const document& mission) {
  exported result;
  const auto home = home_to_write(mission);
  if (mission.return_point && mission.return_point->altitude_m != 0)
    result.losses.add({{},
                       "return point: height of " + number_text(mission.return_point->altitude_m) + " m",
                       "a plan's home position is on the ground",
                       "left out"});
  add_place_losses(mission.items, result.losses);
  const json head{{"cruiseSpeed", usual_mps},
                  {"firmwareType", px4},
                  {"globalPlanAltitudeMode", above_home},
                  {"hoverSpeed", usual_mps},
                  {"items", items_of(mission)},
                  {"plannedHomePosition", json::array({home.latitude, home.longitude, home.above_sea_m.value_or(0)})},
                  {"vehicleType", multirotor},
                  {"version", 2}};
  const json plan{{"fileType", "Plan"},
                  {"geoFence", fence_of(mission, result.losses)},
                  {"groundStation", "QGroundControl"},
                  {"mission", head},
                  {"rallyPoints", {{"points", json::array()}, {"version", 2}}},
                  {"version", 1}};
  constexpr int indent = 4; // as QGroundControl does
  result.text = plan.dump(indent) + '\n';
  return result;
}

} // namespace godwit::mission
