#include "actors/domain/mission/convert/plan_patterns.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "actors/domain/mission/polygon_rules.hpp"
#include "actors/domain/mission/rules.hpp"

namespace godwit::mission {

namespace {

constexpr const char* left_out = "left out";

void lose(plan_source& source, const plan_node& node, std::string what, std::string why, std::string instead) {
  source.losses.add({node.item, std::move(what), std::move(why), std::move(instead)});
}

bool is_of_first_form(const plan_node& node) { return node.has("param1") && !node.has("params"); }

// The lines that the ground station had laid for the pattern.
void take_laid_items(plan_source& source, const plan_node& transects, item_importer& importer) {
  const auto items = source.list(transects, "Items");
  if (items.empty())
    lose(source, transects, "the pattern", "the file does not have its lines", left_out);
  for (const auto& each : items)
    if (const auto simple = read_simple_item(source, each))
      importer.take(*simple);
}

bool is_above_home(plan_source& source, const plan_node& camera) {
  constexpr std::int64_t relative = 1;
  if (camera.has("DistanceMode"))
    return source.integer(camera, "DistanceMode") == relative;
  return source.flag_or(camera, "DistanceToSurfaceRelative", false);
}

bool has_laid_items(const plan_node& transects) {
  return transects.has("Items") && (*transects.value)["Items"].is_array() && !(*transects.value)["Items"].empty();
}

bool triggers_camera(const plan_node& transects) {
  if (!has_laid_items(transects))
    return false;
  return std::ranges::any_of((*transects.value)["Items"], [](const nlohmann::json& each) {
    return each.is_object() && each.contains("command") && each["command"].is_number_integer() &&
           each["command"] != command::waypoint;
  });
}

// What a survey of a mission does not know, although it flies over the same area.
bool has_survey_details(plan_source& source, const plan_node& node, const plan_node& transects) {
  return triggers_camera(transects) || source.flag_or(transects, "HoverAndCapture", false) ||
         source.flag_or(transects, "Refly90Degrees", false) || source.flag_or(node, "flyAlternateTransects", false);
}

// Of a survey whose lines were never laid, so that they say nothing about the camera.
std::optional<survey_camera> camera_of(plan_source& source, const plan_node& transects, const plan_node& camera) {
  const auto distance_m = source.number_or(camera, "AdjustedFootprintFrontal", 0);
  if (!(distance_m > 0))
    return std::nullopt;
  return survey_camera{{distance_m, std::nullopt}, std::nullopt, source.number_or(transects, "TurnAroundDistance", 0)};
}

// Why this survey can not be one of a mission; empty when it can.
std::string why_no_survey(plan_source& source, const plan_node& transects, const survey& area,
                          const plan_node& camera) {
  if (source.flag_or(transects, "FollowTerrain", false))
    return "it follows the terrain";
  if (!is_above_home(source, camera))
    return "its height is not above home";
  if (!(area.line_spacing_m > 0))
    return "its lines have no distance";
  if (area.polygon.size() > max_polygon_corners)
    return "its area has " + std::to_string(area.polygon.size()) + " corners";
  const auto fault = polygon_fault(area.polygon);
  return fault ? "its area " + *fault : "";
}

void import_survey(plan_source& source, const plan_node& node, item_importer& importer) {
  const auto transects = source.object(node, "TransectStyleComplexItem");
  const auto camera = source.object(transects, "CameraCalc");
  const auto angle = std::remainder(source.number_or(node, "angle", 0), 360);
  survey area;
  area.polygon = source.corners(node, "polygon");
  area.altitude_m = source.number(camera, "DistanceToSurface");
  area.line_spacing_m = source.number(camera, "AdjustedFootprintSide");
  area.heading_deg = angle < 0 ? angle + 360 : angle;
  if (*area.heading_deg >= 360) // a tiny negative angle, rounded
    area.heading_deg = 0;
  // The lines as the ground station has laid them keep all of it.
  const auto why = why_no_survey(source, transects, area, camera);
  const bool has_turns = source.number_or(transects, "TurnAroundDistance", 0) != 0;
  if (has_laid_items(transects) && (!why.empty() || has_turns || has_survey_details(source, node, transects)))
    return take_laid_items(source, transects, importer);
  if (!why.empty())
    return lose(source, node, "survey: its area", why + ", and the file does not have its lines", left_out);
  const bool is_unlaid = transects.has("Items") && !has_laid_items(transects); // as godwit writes it
  if (is_unlaid)
    area.camera = camera_of(source, transects, camera);
  if (has_survey_details(source, node, transects) || (has_turns && !area.camera))
    lose(source, node,
         "survey: turns outside of the area, pictures in hover, a second flight across or every other line",
         "the file does not have its lines, and a survey of a mission has none of that", "flown over the area once");
  importer.append(std::move(area), {node.pointer, "item " + std::to_string(node.item.value_or(0)) + ", survey"},
                  node.item.value_or(0));
}

void import_corridor(plan_source& source, const plan_node& node, item_importer& importer) {
  take_laid_items(source, source.object(node, "TransectStyleComplexItem"), importer);
}

// As the ground station lays it (QGroundControl's LandingComplexItem): a mark, the end of pictures, down in circles or
// straight from the approach, the landing. Version 1 called the beginning of the approach loiterCoordinate.
void import_landing(plan_source& source, const plan_node& node, item_importer& importer) {
  const auto* const approach_key =
      node.has("landingApproachCoordinate") ? "landingApproachCoordinate" : "loiterCoordinate";
  const auto approach = source.place(node, approach_key);
  const auto landing = source.place(node, "landCoordinate");
  const auto before = source.problems.size();
  const auto used_frame = source.flag(node, "altitudesAreRelative") ? frame::global_relative : frame::global;
  if (source.problems.size() != before)
    return;
  const auto number = node.item.value_or(0);
  const auto part = [&](std::uint16_t id, std::uint8_t in, const std::array<double, command_params>& params) {
    importer.take({number, id, in, params, true, node.pointer, number + 1});
  };
  const auto at_place = [&](std::uint16_t id, const std::array<double, 4>& params, const std::array<double, 3>& at) {
    part(id, used_frame, {params[0], params[1], params[2], params[3], at[0], at[1], at[2]});
  };
  const auto type = source.text(node, "complexItemType");
  const bool is_vtol = type != "fwLandingPattern";
  part(command::land_start, frame::mission, {});
  if (source.flag_or(node, "stopTakingPhotos", false)) {
    part(command::trigger_distance, frame::mission, {});
    part(command::stop_capture, frame::mission, {});
  }
  if (source.flag_or(node, "stopVideoPhotos", false))
    part(command::stop_video, frame::mission, {});
  const auto radius_m =
      source.number_or(node, "loiterRadius", 0) * (source.flag_or(node, "loiterClockwise", true) ? 1 : -1);
  if (source.flag_or(node, "useLoiterToAlt", true))
    at_place(command::loiter_to_alt, {1, radius_m, 0, 1}, approach);
  else
    at_place(command::waypoint, {0, 0, 0, not_given}, approach);
  at_place(is_vtol ? command::vtol_land : command::land, {0, 0, 0, is_vtol ? not_given : 0}, landing);
}

constexpr std::size_t params_before_place = 4;

// The first form of an item: param1 to param4 beside its coordinate.
std::vector<plan_node> first_params(plan_source& source, const plan_node& node) {
  std::vector<plan_node> result;
  for (std::size_t i = 1; i <= params_before_place; ++i) {
    const auto key = "param" + std::to_string(i);
    (void)source.number(node, key); // a problem where it is none
    if (node.has(key))
      result.push_back({&(*node.value)[key], pointer_to(node.pointer, key), node.item});
  }
  return result;
}

// Seven of them, or in older files four and the place beside them.
void read_params(plan_source& source, const plan_node& node, vehicle_item& item) {
  auto params = is_of_first_form(node) ? first_params(source, node) : source.list(node, "params");
  if (node.has("coordinate") && params.size() == params_before_place)
    for (auto& each : source.list(node, "coordinate"))
      params.push_back(std::move(each));
  else if (node.has("coordinate"))
    source.wrong(node, "has a coordinate besides " + std::to_string(params.size()) + " params",
                 "either 7 params, or 4");
  if (params.size() != item.params.size())
    source.wrong(node, "has " + std::to_string(params.size()) + " params", "7, or 4 and a coordinate of 3");
  for (std::size_t i = 0; i < std::min(params.size(), item.params.size()); ++i) {
    if (!params[i].value->is_number() && !params[i].value->is_null())
      source.wrong(params[i], "is of another type", "a number or null");
    item.params.at(i) = params[i].value->is_number() ? params[i].value->get<double>() : not_given;
  }
}

struct pattern_row {
  std::string_view type; // "complexItemType"
  std::int64_t first_version;
  std::int64_t last_version;
  void (*import)(plan_source& source, const plan_node& node, item_importer& importer);
};

// The versions are those whose form we know; an older or newer one is left out as a loss.
constexpr pattern_row patterns[] = {
    {"survey", 4, 5, import_survey},
    {"CorridorScan", 2, 3, import_corridor},
    {"fwLandingPattern", 1, 2, import_landing},
    {"vtolLandingPattern", 1, 2, import_landing},
    {"VTOLLandingPattern", 1, 2, import_landing},
};

} // namespace

std::optional<vehicle_item> read_simple_item(plan_source& source, const plan_node& node) {
  const auto before = source.problems.size();
  source.lose_unknown(node, {"AMSLAltAboveTerrain", "Altitude", "AltitudeMode", "autoContinue", "command", "coordinate",
                             "doJumpId", "frame", "id", "param1", "param2", "param3", "param4", "params", "type",
                             "MISSION_ITEM_ID", "altitude", "altitudeMode",
                             "amslaltAboveTerrain"}); // in older files in small letters
  vehicle_item result;
  result.number = node.item.value_or(0);
  result.place = node.pointer;
  const auto id = source.integer(node, "command");
  const auto used_frame = source.integer(node, "frame");
  if (id < 0 || id > std::numeric_limits<std::uint16_t>::max() || used_frame < 0 ||
      used_frame > std::numeric_limits<std::uint8_t>::max())
    source.wrong(node, "has a command or frame that MAVLink does not have", {});
  result.command = static_cast<std::uint16_t>(id);
  result.frame = static_cast<std::uint8_t>(used_frame);
  result.autocontinue = source.flag(node, "autoContinue");
  result.jump_number = result.number + 1; // where the file does not say it; home is 0
  if (node.has("doJumpId"))
    result.jump_number = static_cast<std::size_t>(std::max<std::int64_t>(0, source.integer(node, "doJumpId")));
  read_params(source, node, result);
  return source.problems.size() == before ? std::optional(result) : std::nullopt;
}

void import_pattern(plan_source& source, const plan_node& node, item_importer& importer) {
  const auto type = source.text(node, "complexItemType");
  const auto found = std::ranges::find(patterns, std::string_view(type), &pattern_row::type);
  if (found == std::end(patterns))
    return lose(source, node, "the pattern " + in_quotes(type), "a mission has no counterpart of it", left_out);
  const auto version = source.integer(node, "version");
  if (version < found->first_version || version > found->last_version)
    return lose(source, node, type + " of version " + std::to_string(version), "its form is not known", left_out);
  found->import(source, node, importer);
}

} // namespace godwit::mission
