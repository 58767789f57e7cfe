#include "actors/domain/mission/convert/geojson_import.hpp"

#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>

#include "actors/domain/mission/json_document.hpp"
#include "actors/domain/mission/read.hpp"
#include "io/fields/field_table.hpp"

namespace godwit::mission {

namespace {

using nlohmann::json;

const json& at_or_null(const json& value, const char* key) {
  static const json nothing;
  const auto found = value.find(key);
  return value.is_object() && found != value.end() ? *found : nothing;
}

bool has_type(const json& value, const char* type) { return at_or_null(value, "type") == type; }

// Anything odd becomes something that the checks of a mission refuse, with the reason.
json position_of(const json& geometry) {
  const auto& place = at_or_null(geometry, "coordinates");
  if (!has_type(geometry, "Point") || !place.is_array() || place.size() != 3)
    return geometry;
  return {{"longitude", place[0]}, {"latitude", place[1]}, {"altitude_m", place[2]}};
}

json planned_home_of(const json& geometry) {
  const auto& place = at_or_null(geometry, "coordinates");
  if (!has_type(geometry, "Point") || !place.is_array() || place.size() < 2 || place.size() > 3)
    return geometry;
  json home{{"longitude", place[0]}, {"latitude", place[1]}};
  if (place.size() == 3)
    home["above_sea_m"] = place[2];
  return home;
}

json corners_of(const json& geometry) {
  const auto& rings = at_or_null(geometry, "coordinates");
  if (!has_type(geometry, "Polygon") || !rings.is_array() || rings.size() != 1 || !rings[0].is_array())
    return geometry;
  auto corners = json::array();
  for (const auto& each : rings[0])
    corners.push_back(each.is_array() && each.size() >= 2 ? json{{"longitude", each[0]}, {"latitude", each[1]}} : each);
  if (corners.size() > 1 && corners.front() == corners.back()) // a ring is closed, ours is not
    corners.erase(corners.size() - 1);
  return corners;
}

// What we write into the properties of an item or a fence. Maps add their own (colours, row numbers, null in each
// column that some other feature has): passed over.
bool is_ours(std::string_view name) {
  const auto has = [&]<class T>(std::type_identity<T>) {
    bool found = false;
    io::for_each_field<T>([&](const auto& entry) { found = found || entry.name == name; });
    return found;
  };
  const bool is_of_item = [&]<class... T>(std::type_identity<std::variant<T...>>) {
    return (has(std::type_identity<T>{}) || ...);
  }(std::type_identity<item>{});
  return name == "kind" || is_of_item || has(std::type_identity<geofence>{});
}

json ours_of(const json& properties) {
  auto result = json::object();
  for (const auto& [key, value] : properties.items())
    if (is_ours(key) && !value.is_null())
      result[key] = value;
  return result;
}

json item_of(json fields, const json& geometry) {
  if (has_type(geometry, "Point"))
    fields["at"] = position_of(geometry);
  else if (!geometry.is_null())
    fields["polygon"] = corners_of(geometry);
  return fields;
}

// What is wrong with a feature; it goes into MISSION if nothing is.
std::optional<document_problem> take_feature(const json& feature, const std::string& pointer, json& mission) {
  const auto& properties = at_or_null(feature, "properties");
  const auto& role = at_or_null(properties, "role");
  const auto& geometry = at_or_null(feature, "geometry");
  if (!has_type(feature, "Feature") || !role.is_string())
    return document_problem{pointer, "is no feature of a mission", "a Feature with the property `role`"};
  auto fields = ours_of(properties);
  const bool needs_height = role == "item" || role == "return_point" || role == "rally_point";
  if (needs_height && has_type(geometry, "Point") && at_or_null(geometry, "coordinates").size() == 2)
    return document_problem{pointer_to(pointer_to(pointer, "geometry"), "coordinates"),
                            "has no height; the program that has saved the map has dropped it",
                            "[longitude, latitude, metres above the place of take-off]"};
  if (role == "item") {
    mission["items"].push_back(item_of(std::move(fields), geometry));
  } else if (role == "geofence") {
    fields["vertices"] = corners_of(geometry);
    mission["geofences"].push_back(std::move(fields));
  } else if (role == "return_point") {
    mission["return_point"] = position_of(geometry);
  } else if (role == "breach_return_point") {
    mission["breach_return_point"] = position_of(geometry);
  } else if (role == "rally_point") {
    mission["rally_points"].push_back(position_of(geometry));
  } else if (role == "planned_home") {
    mission["planned_home"] = planned_home_of(geometry);
  } else if (role != "path") {
    return document_problem{pointer_to(pointer_to(pointer, "properties"), "role"),
                            "is " + in_quotes(role.get<std::string>()),
                            "item, geofence, return_point, planned_home, breach_return_point, rally_point or path"};
  }
  return std::nullopt;
}

tl::unexpected<conversion_error> failed(document_problem problem, std::string_view text) {
  return tl::unexpected(conversion_error{bounded({document_errc::wrong_form, {std::move(problem)}}, text), {}});
}

} // namespace

import_result import_geojson(std::string_view text, const import_options& options) {
  const auto parsed = parse_document(text, max_mission_bytes);
  if (!parsed)
    return tl::unexpected(conversion_error{parsed.error(), {}});
  const auto& head = at_or_null(*parsed, "godwit");
  const auto& features = at_or_null(*parsed, "features");
  if (!has_type(*parsed, "FeatureCollection") || !features.is_array() || !head.is_object())
    return failed({{}, "is no GeoJSON of a mission", "a FeatureCollection with `godwit` in it"}, text);
  json mission = head;
  mission["items"] = json::array();
  mission["geofences"] = json::array();
  source_map places;
  for (std::size_t i = 0; i < features.size(); ++i) {
    const auto pointer = pointer_to("/features", i);
    if (auto problem = take_feature(features[i], pointer, mission))
      return failed(std::move(*problem), text);
    places.items.resize(mission["items"].size(), {pointer, {}});
    places.geofences.resize(mission["geofences"].size(), {pointer, {}});
  }
  if (options.mission_id)
    mission["mission_id"] = *options.mission_id;
  auto result = read<document>(mission.dump(-1, ' ', false, json::error_handler_t::replace));
  if (!result) {
    document named; // of which only the ids are asked
    for (const auto& each : mission["items"])
      named.items.emplace_back(takeoff{at_or_null(each, "id").is_string() ? each["id"].get<std::string>() : "", 0});
    return tl::unexpected(conversion_error{bounded(in_source(std::move(result.error()), named, places), text), {}});
  }
  return finished(*result, {}, options, text, places);
}

} // namespace godwit::mission
