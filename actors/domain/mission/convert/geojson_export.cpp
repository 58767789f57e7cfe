#include "actors/domain/mission/convert/geojson_export.hpp"

#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

#include "actors/domain/mission/polygon_rules.hpp"
#include "actors/domain/mission/write.hpp"

namespace godwit::mission {

namespace {

using ordered_json = nlohmann::ordered_json; // a person reads it: the kind first, not the alphabet

ordered_json place_of(const ordered_json& at) {
  return ordered_json::array({at["longitude"], at["latitude"], at["altitude_m"]});
}

ordered_json point_of(const ordered_json& at) { return {{"type", "Point"}, {"coordinates", place_of(at)}}; }

// The first corner stays the first when the order has to be turned round.
ordered_json ring_of(const std::vector<vertex>& corners) {
  auto ring = ordered_json::array();
  const bool is_clockwise = signed_area(corners) < 0;
  for (std::size_t i = 0; i <= corners.size(); ++i) {
    const auto& each = corners[(is_clockwise ? corners.size() - i : i) % corners.size()];
    ring.push_back(ordered_json::array({each.longitude, each.latitude}));
  }
  return {{"type", "Polygon"}, {"coordinates", ordered_json::array({std::move(ring)})}};
}

ordered_json feature(std::string_view role, ordered_json geometry, const ordered_json& rest) {
  ordered_json properties{{"role", role}};
  properties.update(rest);
  return {{"type", "Feature"}, {"geometry", std::move(geometry)}, {"properties", std::move(properties)}};
}

ordered_json fields_of(const auto& value) {
  std::string text;
  append_text(text, value);
  return ordered_json::parse(text);
}

ordered_json item_feature(const item& each, ordered_json& path) {
  auto fields = fields_of(each);
  ordered_json geometry;
  if (fields.contains("at")) {
    geometry = point_of(fields["at"]);
    path.push_back(geometry["coordinates"]);
    fields.erase("at");
  } else if (const auto* area = std::get_if<survey>(&each)) {
    geometry = ring_of(area->polygon);
    fields.erase("polygon");
  }
  return feature("item", std::move(geometry), fields);
}

ordered_json fence_feature(const geofence& each) {
  auto fields = fields_of(each);
  fields.erase("vertices");
  return feature("geofence", ring_of(each.vertices), fields);
}

ordered_json planned_home_feature(const planned_home& home) {
  auto place = ordered_json::array({home.longitude, home.latitude});
  if (home.above_sea_m)
    place.push_back(*home.above_sea_m);
  return feature("planned_home", {{"type", "Point"}, {"coordinates", std::move(place)}}, ordered_json::object());
}

} // namespace

exported export_geojson(const document& mission) {
  auto features = ordered_json::array();
  auto path = ordered_json::array();
  for (const auto& each : mission.items)
    features.push_back(item_feature(each, path));
  for (const auto& each : mission.geofences)
    features.push_back(fence_feature(each));
  if (mission.return_point)
    features.push_back(feature("return_point", point_of(fields_of(*mission.return_point)), ordered_json::object()));
  if (mission.planned_home)
    features.push_back(planned_home_feature(*mission.planned_home));
  if (mission.breach_return_point)
    features.push_back(
        feature("breach_return_point", point_of(fields_of(*mission.breach_return_point)), ordered_json::object()));
  if (mission.rally_points)
    for (const auto& each : *mission.rally_points)
      features.push_back(feature("rally_point", point_of(fields_of(each)), ordered_json::object()));
  if (path.size() > 1)
    features.push_back(feature("path", ordered_json{{"type", "LineString"}, {"coordinates", std::move(path)}},
                               ordered_json::object()));
  ordered_json head{
      {"mission_id", mission.mission_id}, {"schema_version", mission.schema_version}, {"revision", mission.revision}};
  if (mission.vehicle)
    head["vehicle"] = io::name_of(*mission.vehicle);
  const ordered_json collection{
      {"type", "FeatureCollection"}, {"godwit", std::move(head)}, {"features", std::move(features)}};
  constexpr int indent = 2;
  return {collection.dump(indent) + '\n', {}};
}

} // namespace godwit::mission
