#include "actors/domain/mission/convert/plan_export.hpp"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "actors/domain/geofence/fence_name.hpp"
#include "actors/domain/mission/commands/command_table.hpp"
#include "actors/domain/mission/convert/item_export.hpp"
#include "actors/domain/mission/convert/plan_vehicle.hpp"

namespace godwit::mission {

namespace {

using nlohmann::json;

constexpr int any_vehicle = 0; // MAV_TYPE_GENERIC
constexpr int multirotor = 2;
constexpr int above_home = 1;   // QGroundControl's AltitudeMode
constexpr double usual_mps = 5; // only for the ground station's estimate of the time

json simple_item(const vehicle_item& each) {
  auto params = json::array();
  for (const auto value : each.params)
    params.push_back(std::isfinite(value) ? json(value) : json());
  json result{{"type", "SimpleItem"},    {"autoContinue", each.autocontinue},
              {"command", each.command}, {"doJumpId", each.number},
              {"frame", each.frame},     {"params", std::move(params)}};
  if (each.frame == frame::global_relative && std::isfinite(each.altitude_m())) {
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
  const auto& shots = each.camera;
  const json camera{{"AdjustedFootprintFrontal", shots ? shots->trigger.distance_m.value_or(0) : 0},
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
                       {"TurnAroundDistance", shots ? shots->turnaround_m : 0},
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
  auto circles = json::array();
  for (std::size_t i = 0; i < mission.geofences.size(); ++i) {
    const auto& each = mission.geofences[i];
    if (each.floor_m || each.ceiling_m)
      losses.add({{},
                  godwit::geofence::fence_name(i) + ": floor and ceiling",
                  "the fences of a plan have no heights",
                  "left out"});
    const bool keeps_in = each.kind == fence_kind::inclusion;
    if (each.circle) {
      const json circle{{"center", json::array({each.circle->latitude, each.circle->longitude})},
                        {"radius", each.circle->radius_m}};
      circles.push_back({{"circle", circle}, {"inclusion", keeps_in}, {"version", 1}});
      continue;
    }
    polygons.push_back({{"inclusion", keeps_in}, {"polygon", pairs_of(each.vertices)}, {"version", 1}});
  }
  json fence{{"circles", std::move(circles)}, {"polygons", std::move(polygons)}, {"version", 2}};
  if (const auto& back = mission.breach_return_point)
    fence["breachReturn"] = json::array({back->latitude, back->longitude, back->altitude_m});
  return fence;
}

json rally_points_of(const document& mission) {
  auto points = json::array();
  if (mission.rally_points)
    for (const auto& each : *mission.rally_points)
      points.push_back(json::array({each.latitude, each.longitude, each.altitude_m}));
  return points;
}

void add_camera_losses(const survey& area, std::size_t index, loss_list& losses) {
  constexpr std::string_view left_out = "left out";
  if (area.camera && area.camera->trigger.interval_s)
    losses.add(
        {index, "the survey: pictures by time", "the surveys of a plan take them by distance", std::string(left_out)});
  if (area.camera && area.camera->gimbal_pitch_deg)
    losses.add(
        {index, "the survey: the pitch of the gimbal", "the surveys of a plan have none", std::string(left_out)});
}

json items_of(const document& mission, loss_list& losses) {
  auto items = json::array();
  const auto made = numbered_items_of(mission, 1, true);
  for (std::size_t i = 0; i < mission.items.size(); ++i) {
    if (const auto* area = std::get_if<survey>(&mission.items[i])) {
      items.push_back(survey_pattern(*area));
      add_camera_losses(*area, i, losses);
    }
    for (const auto& simple : made[i])
      items.push_back(simple_item(simple));
  }
  return items;
}

bool is_for_px4(const document& mission) {
  return std::ranges::all_of(mission.items, [](const item& each) {
    const auto* const command = std::get_if<command_item>(&each);
    const auto* const row = command == nullptr ? nullptr : command_of(command->command);
    return row == nullptr || row->answer_of(vehicle_profile::px4_multicopter) != item_answer::refused;
  });
}

// Of a mission that names none: PX4, to which a yaw of NaN is "leave it", which is what we mean. What kind of vehicle
// commands are for, they do not say: what one kind ignores in them, another one executes.
plan_vehicle vehicle_of(const document& mission) {
  if (mission.vehicle)
    return plan_vehicle_of(*mission.vehicle);
  const bool has_commands = std::ranges::any_of(mission.items, is_of_version_2);
  return {is_for_px4(mission) ? px4_firmware : ardupilot_firmware, has_commands ? any_vehicle : multirotor};
}

constexpr int indent = 4; // as QGroundControl does

} // namespace

std::optional<std::string> plan_again(std::string_view text) {
  const auto plan = json::parse(text);
  const bool is_of_this_form = plan.contains("mission") && plan["mission"]["version"] == 2;
  return is_of_this_form ? std::optional(plan.dump(indent) + '\n') : std::nullopt;
}

exported export_plan(const document& mission) {
  exported result;
  const auto home = home_to_write(mission);
  if (mission.return_point && mission.return_point->altitude_m != 0)
    result.losses.add({{},
                       "return point: height of " + number_text(mission.return_point->altitude_m) + " m",
                       "a plan's home position is on the ground",
                       "left out"});
  add_place_losses(mission.items, result.losses);
  const auto vehicle = vehicle_of(mission);
  const json head{{"cruiseSpeed", usual_mps},
                  {"firmwareType", vehicle.autopilot},
                  {"globalPlanAltitudeMode", above_home},
                  {"hoverSpeed", usual_mps},
                  {"items", items_of(mission, result.losses)},
                  {"plannedHomePosition", json::array({home.latitude, home.longitude, home.above_sea_m.value_or(0)})},
                  {"vehicleType", vehicle.type},
                  {"version", 2}};
  const json plan{{"fileType", "Plan"},
                  {"geoFence", fence_of(mission, result.losses)},
                  {"groundStation", "QGroundControl"},
                  {"mission", head},
                  {"rallyPoints", {{"points", rally_points_of(mission)}, {"version", 2}}},
                  {"version", 1}};
  result.text = plan.dump(indent) + '\n';
  return result;
}

} // namespace godwit::mission
