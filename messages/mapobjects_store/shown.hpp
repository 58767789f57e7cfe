// What lies on a part of the map, for people who look at it. Degrees of WGS84; times are nanoseconds since 1970 (UTC).
// Thread: plain values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/fields/field_table.hpp"
#include "messages/mapobjects_store/answer.hpp"
#include "messages/mapobjects_store/object.hpp"

namespace godwit::mapobjects_store {

inline constexpr std::uint32_t max_shown_objects = 500;      // more are a carpet on a screen
inline constexpr std::uint64_t max_counted_objects = 10'000; // of those that were pulled, and of those seen here

// A west above its east leads across the antimeridian.
struct map_part {
  double west_deg = -180;
  double south_deg = -90;
  double east_deg = 180;
  double north_deg = 90;
  GODWIT_FIELDS(map_part, "mapobjects_store.map_part", west_deg, south_deg, east_deg, north_deg);
};

// Answered with shown_objects.
struct get_objects {
  map_part within;
  std::uint32_t limit = max_shown_objects; // more is as much
  GODWIT_FIELDS(get_objects, "mapobjects_store.get_objects", within, limit);
};

struct shown_object {
  std::string class_group;
  geo_position position;
  std::int64_t last_seen_ns = 0;
  double confidence = 0;     // 0..1
  bool is_seen_here = false; // found or moved by this vehicle, and not in the map that was pulled
  GODWIT_FIELDS(shown_object, "mapobjects_store.shown_object", class_group, position, last_seen_ns, confidence,
                is_seen_here);
};

struct shown_objects {
  std::vector<shown_object> list; // the newest of those that were counted, the newest first
  std::uint64_t counted = 0;      // that lie there, those of the list among them
  bool is_all = true;             // false: there are more, which nobody has looked at
  map_failure failure = map_failure::none;
  std::string error;
  GODWIT_FIELDS(shown_objects, "mapobjects_store.shown_objects", list, counted, is_all, failure, error);
};

} // namespace godwit::mapobjects_store
