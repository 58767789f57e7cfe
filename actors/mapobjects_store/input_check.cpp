#include "actors/mapobjects_store/input_check.hpp"

#include "actors/domain/geo/geodesic.hpp"
#include "actors/domain/geo/mgrs.hpp"
#include "actors/domain/uuid/uuid.hpp"
#include "actors/mapobjects_store/map_row.hpp"

namespace godwit::mapobjects_store {

namespace {

using checked_input = map_result<void>;

// What the missions service takes: a row that it refuses would take its whole batch along.
constexpr double min_altitude_m = -1'000;
constexpr double max_altitude_m = 20'000;

// Input is repeated in errors up to this length.
constexpr std::size_t max_quoted_bytes = 80;

std::string in_quotes(const std::string& text) { return "\"" + text.substr(0, max_quoted_bytes) + "\""; }

checked_input check_class_group(const std::string& group) {
  if (group.empty() || group.size() > max_class_group_bytes)
    return refused("class_group " + in_quotes(group) + " does not have 1 to " + std::to_string(max_class_group_bytes) +
                   " bytes");
  if (group.find('\0') != std::string::npos)
    return refused("class_group has a character that no text of a document can have: U+0000");
  return {};
}

checked_input check_position(const geo_position& at, const std::string& field) {
  if (!geo::is_valid(point_of(at)))
    return refused(field + " is not on the globe: latitude " + std::to_string(at.latitude_deg) + ", longitude " +
                   std::to_string(at.longitude_deg));
  if (at.altitude_m && !(*at.altitude_m >= min_altitude_m && *at.altitude_m <= max_altitude_m)) // nor not a number
    return refused(field + " has an altitude that is not from -1000 to 20000 m: " + std::to_string(*at.altitude_m));
  return {};
}

checked_input check_share(double share, const std::string& field) {
  if (!(share >= 0 && share <= 1)) // false for what is not a number
    return refused(field + " is not in 0..1: " + std::to_string(share));
  return {};
}

checked_input check_circle(const view_circle& circle) {
  if (!(circle.radius_m >= 0 && circle.radius_m <= max_view_radius_m))
    return refused("circles: a radius is not in 0.." + std::to_string(max_view_radius_m) + " m");
  return check_position(circle.centre, "circles: a centre");
}

checked_input check_polygon(const view_polygon& polygon) {
  if (polygon.vertices.size() < 3 || polygon.vertices.size() > max_view_vertices)
    return refused("polygons: one has " + std::to_string(polygon.vertices.size()) + " vertices, 3 to " +
                   std::to_string(max_view_vertices) + " are possible");
  for (const auto& each : polygon.vertices)
    if (auto sound = check_position(each, "polygons: a vertex"); !sound)
      return sound;
  const auto& first = polygon.vertices.front();
  for (const auto& each : polygon.vertices)
    if (geo::distance_m(point_of(first), point_of(each)) > max_view_radius_m)
      return refused("polygons: a vertex is more than " + std::to_string(max_view_radius_m) + " m from the first one");
  return {};
}

checked_input check_bounds(const pass_end& input) {
  if (input.started_ns > input.ended_ns)
    return refused("the pass ends before it starts");
  if (input.class_groups.empty() || input.class_groups.size() > max_class_groups)
    return refused("class_groups: 1 to " + std::to_string(max_class_groups) + " are possible");
  if (input.circles.size() > max_view_circles || input.polygons.size() > max_view_polygons)
    return refused("more than " + std::to_string(max_view_circles) + " circles or " +
                   std::to_string(max_view_polygons) + " polygons");
  return {};
}

} // namespace

checked_input check_id(const std::string& id, const std::string& field) {
  if (!ids::is_uuid(id))
    return refused(field + " is not a UUID in small letters: " + in_quotes(id));
  return {};
}

checked_input check(const sighting& input) {
  return check_id(input.id, "id")
      .and_then([&] { return check_id(input.mission_id, "mission_id"); })
      .and_then([&] { return check_class_group(input.class_group); })
      .and_then([&] { return check_position(input.position, "position"); })
      .and_then([&] { return check_share(input.confidence, "confidence"); });
}

checked_input check(const operator_verdict& input) {
  return check_id(input.id, "id")
      .and_then([&] { return check_id(input.mission_id, "mission_id"); })
      .and_then([&] { return check_class_group(input.class_group); })
      .and_then([&] { return check_position(input.position, "position"); });
}

checked_input check(const pass_end& input) {
  auto sound = check_id(input.id, "id")
                   .and_then([&] { return check_id(input.mission_id, "mission_id"); })
                   .and_then([&] { return check_share(input.confidence, "confidence"); })
                   .and_then([&] { return check_bounds(input); });
  if (!sound)
    return sound;
  for (const auto& each : input.class_groups)
    if (auto group = check_class_group(each); !group)
      return group;
  for (const auto& each : input.circles)
    if (auto circle = check_circle(each); !circle)
      return circle;
  for (const auto& each : input.polygons)
    if (auto polygon = check_polygon(each); !polygon)
      return polygon;
  return {};
}

checked_input check(const map_object& input) {
  return check_id(input.id, "id of an object")
      .and_then([&] { return check_id(input.mission_id, "mission_id of object " + input.id); })
      .and_then([&] { return check_class_group(input.class_group); })
      .and_then([&] { return check_position(input.position, "position of object " + input.id); })
      .and_then([&] { return check_share(input.confidence, "confidence of object " + input.id); });
}

map_result<ignored_item> checked(ignored_item input) {
  auto sound = check_id(input.id, "id of an ignored item")
                   .and_then([&] { return check_id(input.mission_id, "mission_id of ignored item " + input.id); })
                   .and_then([&] { return check_class_group(input.class_group); });
  if (!sound)
    return tl::unexpected(std::move(sound.error()));
  auto cell = geo::read_mgrs_cell(input.mgrs_cell);
  if (!cell)
    return refused("mgrs_cell of ignored item " + input.id + " names no cell: " + in_quotes(input.mgrs_cell));
  input.mgrs_cell = std::move(*cell);
  return input;
}

} // namespace godwit::mapobjects_store
