// What lies on the map. Ids are UUIDs in small letters; degrees are of WGS84; times are nanoseconds since 1970 (UTC).
// Thread: plain values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "io/fields/field_table.hpp"

namespace godwit::mapobjects_store {

struct geo_position {
  double latitude_deg = 0;
  double longitude_deg = 0;
  std::optional<double> altitude_m; // above mean sea level; distances do not look at it
  GODWIT_FIELDS(geo_position, "mapobjects_store.geo_position", latitude_deg, longitude_deg, altitude_m);
};

struct map_object {
  std::string id;
  std::string mission_id;  // the mission that last said something about it; in a load, that of the load
  std::string class_group; // what kind of thing; only objects of one class group are compared with each other
  geo_position position;
  std::int64_t first_seen_ns = 0;
  std::int64_t last_seen_ns = 0;
  double confidence = 0; // 0..1
  GODWIT_FIELDS(map_object, "mapobjects_store.map_object", id, mission_id, class_group, position, first_seen_ns,
                last_seen_ns, confidence);
};

// Things of this class group in this cell are of no interest.
struct ignored_item {
  std::string id; // known to the service too: a row that comes again is a repetition
  std::string mission_id;
  std::string mgrs_cell;
  std::string class_group;
  std::int64_t since_ns = 0;
  GODWIT_FIELDS(ignored_item, "mapobjects_store.ignored_item", id, mission_id, mgrs_cell, class_group, since_ns);
};

} // namespace godwit::mapobjects_store
