// A mission, as the service writes it (config/schemas/mission.schema.json). Only the service counts revisions. Thread:
// a plain value.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/fields/field_table.hpp"
#include "messages/mission/item.hpp"
#include "messages/mission/item_fields.hpp"
#include "messages/mission/place.hpp"
#include "messages/mission/vehicle_profile.hpp"

namespace godwit::mission {

// The versions of the contract that this program speaks. A document of another major version is refused. Version 2 has
// two more kinds of items; a mission without them is still written as one of version 1, which more readers know.
inline constexpr std::string_view schema_version = "1.0.0";
inline constexpr std::string_view schema_version_2 = "2.0.0";

enum class fence_kind {
  inclusion, // stay inside one of these
  exclusion  // stay outside of all of these
};

constexpr auto enum_names(fence_kind) {
  return io::names<fence_kind>({{fence_kind::inclusion, "INCLUSION"}, {fence_kind::exclusion, "EXCLUSION"}});
}

struct fence_circle {
  double latitude = 0; // of its centre
  double longitude = 0;
  double radius_m = 0;

  GODWIT_FIELDS(fence_circle, "mission.fence_circle", latitude, longitude, radius_m);
  friend bool operator==(const fence_circle&, const fence_circle&) = default;
};

struct geofence {
  fence_kind kind = fence_kind::inclusion;
  std::vector<vertex> vertices;  // of a circle: the polygon that godwit judges by, within it or around it
  std::optional<double> floor_m; // above the place of take-off
  std::optional<double> ceiling_m;
  std::optional<fence_circle> circle{}; // what goes to the vehicle; of version 2

  GODWIT_FIELDS(geofence, "mission.geofence", kind, vertices, floor_m, ceiling_m, circle);
  friend bool operator==(const geofence&, const geofence&) = default;
};

// Where the home of the vehicle was thought to be when the mission was drawn. Nobody flies there.
struct planned_home {
  double latitude = 0;
  double longitude = 0;
  std::optional<double> above_sea_m;

  GODWIT_FIELDS(planned_home, "mission.planned_home", latitude, longitude, above_sea_m);
  friend bool operator==(const planned_home&, const planned_home&) = default;
};

struct document {
  std::string mission_id; // UUID
  std::string schema_version{mission::schema_version};
  std::int32_t revision = 1;
  std::vector<item> items;
  std::vector<geofence> geofences;
  std::optional<position> return_point;              // absent: no item leads there
  std::optional<mission::planned_home> planned_home; // of the file that the mission was read from
  // Where the vehicle's own return leads instead of home, and its fence's: for the vehicle alone. Of version 2.
  std::optional<std::vector<position>> rally_points{}; // never empty
  std::optional<position> breach_return_point{};
  std::optional<vehicle_profile> vehicle{}; // of the file, for which it was drawn; of version 2

  GODWIT_FIELDS(document, "mission.document", mission_id, schema_version, revision, items, geofences, return_point,
                planned_home, rally_points, breach_return_point, vehicle);
  friend bool operator==(const document&, const document&) = default;
};

// Version 1 of the contract can not express it.
[[nodiscard]] inline bool needs_version_2(const document& value) {
  const auto has_circle = [](const geofence& each) { return each.circle.has_value(); };
  return value.rally_points || value.breach_return_point || value.vehicle ||
         std::ranges::any_of(value.items, is_of_version_2) || std::ranges::any_of(value.geofences, has_circle);
}

} // namespace godwit::mission
