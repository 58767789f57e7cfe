// A mission, as the service writes it (config/schemas/mission.schema.json). Only the service counts revisions. Thread:
// a plain value.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/fields/field_table.hpp"
#include "messages/mission/item.hpp"
#include "messages/mission/item_fields.hpp"
#include "messages/mission/place.hpp"

namespace godwit::mission {

// The version of the contract that this program speaks. A document of another major version is refused.
inline constexpr std::string_view schema_version = "1.0.0";

enum class fence_kind {
  inclusion, // stay inside one of these
  exclusion  // stay outside of all of these
};

constexpr auto enum_names(fence_kind) {
  return io::names<fence_kind>({{fence_kind::inclusion, "INCLUSION"}, {fence_kind::exclusion, "EXCLUSION"}});
}

struct geofence {
  fence_kind kind = fence_kind::inclusion;
  std::vector<vertex> vertices;
  std::optional<double> floor_m; // above the place of take-off
  std::optional<double> ceiling_m;

  static constexpr auto fields =
      io::table("mission.geofence", io::field("kind", &geofence::kind), io::field("vertices", &geofence::vertices),
                io::field("floor_m", &geofence::floor_m), io::field("ceiling_m", &geofence::ceiling_m));
  friend bool operator==(const geofence&, const geofence&) = default;
};

// Where the home of the vehicle was thought to be when the mission was drawn. Nobody flies there.
struct planned_home {
  double latitude = 0;
  double longitude = 0;
  std::optional<double> above_sea_m;

  static constexpr auto fields =
      io::table("mission.planned_home", io::field("latitude", &planned_home::latitude),
                io::field("longitude", &planned_home::longitude), io::field("above_sea_m", &planned_home::above_sea_m));
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

  static constexpr auto fields =
      io::table("mission.document", io::field("mission_id", &document::mission_id),
                io::field("schema_version", &document::schema_version), io::field("revision", &document::revision),
                io::field("items", &document::items), io::field("geofences", &document::geofences),
                io::field("return_point", &document::return_point), io::field("planned_home", &document::planned_home));
  friend bool operator==(const document&, const document&) = default;
};

} // namespace godwit::mission
