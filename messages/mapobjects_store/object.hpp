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
  static constexpr auto fields = io::table(
      "mapobjects_store.geo_position", io::field("latitude_deg", &geo_position::latitude_deg),
      io::field("longitude_deg", &geo_position::longitude_deg), io::field("altitude_m", &geo_position::altitude_m));
};

struct map_object {
  std::string id;
  std::string mission_id;  // the mission that last said something about it; in a load, that of the load
  std::string class_group; // what kind of thing; only objects of one class group are compared with each other
  geo_position position;
  std::int64_t first_seen_ns = 0;
  std::int64_t last_seen_ns = 0;
  double confidence = 0; // 0..1
  static constexpr auto fields =
      io::table("mapobjects_store.map_object", io::field("id", &map_object::id),
                io::field("mission_id", &map_object::mission_id), io::field("class_group", &map_object::class_group),
                io::field("position", &map_object::position), io::field("first_seen_ns", &map_object::first_seen_ns),
                io::field("last_seen_ns", &map_object::last_seen_ns), io::field("confidence", &map_object::confidence));
};

// Things of this class group in this cell are of no interest.
struct ignored_item {
  std::string id; // known to the service too: a row that comes again is a repetition
  std::string mission_id;
  std::string mgrs_cell;
  std::string class_group;
  std::int64_t since_ns = 0;
  static constexpr auto fields =
      io::table("mapobjects_store.ignored_item", io::field("id", &ignored_item::id),
                io::field("mission_id", &ignored_item::mission_id), io::field("mgrs_cell", &ignored_item::mgrs_cell),
                io::field("class_group", &ignored_item::class_group), io::field("since_ns", &ignored_item::since_ns));
};

} // namespace godwit::mapobjects_store
