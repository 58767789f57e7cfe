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
  static constexpr auto fields =
      io::table("mapobjects_store.map_part", io::field("west_deg", &map_part::west_deg),
                io::field("south_deg", &map_part::south_deg), io::field("east_deg", &map_part::east_deg),
                io::field("north_deg", &map_part::north_deg));
};

// Answered with shown_objects.
struct get_objects {
  map_part within;
  std::uint32_t limit = max_shown_objects; // more is as much
  static constexpr auto fields = io::table("mapobjects_store.get_objects", io::field("within", &get_objects::within),
                                           io::field("limit", &get_objects::limit));
};

struct shown_object {
  std::string class_group;
  geo_position position;
  std::int64_t last_seen_ns = 0;
  double confidence = 0;     // 0..1
  bool is_seen_here = false; // found or moved by this vehicle, and not in the map that was pulled
  static constexpr auto fields = io::table(
      "mapobjects_store.shown_object", io::field("class_group", &shown_object::class_group),
      io::field("position", &shown_object::position), io::field("last_seen_ns", &shown_object::last_seen_ns),
      io::field("confidence", &shown_object::confidence), io::field("is_seen_here", &shown_object::is_seen_here));
};

struct shown_objects {
  std::vector<shown_object> list; // the newest of those that were counted, the newest first
  std::uint64_t counted = 0;      // that lie there, those of the list among them
  bool is_all = true;             // false: there are more, which nobody has looked at
  map_failure failure = map_failure::none;
  std::string error;
  static constexpr auto fields =
      io::table("mapobjects_store.shown_objects", io::field("list", &shown_objects::list),
                io::field("counted", &shown_objects::counted), io::field("is_all", &shown_objects::is_all),
                io::field("failure", &shown_objects::failure), io::field("error", &shown_objects::error));
};

} // namespace godwit::mapobjects_store
