// The end of a pass over an area: what was in view and not seen may be gone. Thread: plain values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/fields/field_table.hpp"
#include "messages/mapobjects_store/answer.hpp"
#include "messages/mapobjects_store/object.hpp"

namespace godwit::mapobjects_store {

struct view_circle {
  geo_position centre;
  double radius_m = 0;
  GODWIT_FIELDS(view_circle, "mapobjects_store.view_circle", centre, radius_m);
};

struct view_polygon {
  std::vector<geo_position> vertices; // at least three
  GODWIT_FIELDS(view_polygon, "mapobjects_store.view_polygon", vertices);
};

// Answered with pass_answer. Who hears no answer says it again with the same id: each object is missed at most once in
// a pass.
struct pass_end {
  std::string id; // UUID
  std::string mission_id;
  std::int64_t started_ns = 0; // by the same clock as the sightings
  std::int64_t ended_ns = 0;
  std::vector<std::string> class_groups; // what was looked for; others are not missed
  std::vector<view_circle> circles;      // what was in view is what lies in any of these
  std::vector<view_polygon> polygons;
  double confidence = 0; // 0..1, that what was there would have been seen
  GODWIT_FIELDS(pass_end, "mapobjects_store.pass_end", id, mission_id, started_ns, ended_ns, class_groups, circles,
                polygons, confidence);
};

struct pass_reviewed {
  std::string id;
  std::uint64_t in_view = 0;            // objects looked at
  std::uint64_t removed_candidates = 0; // observations of that kind, those of an earlier try included
  GODWIT_FIELDS(pass_reviewed, "mapobjects_store.pass_reviewed", id, in_view, removed_candidates);
};

struct pass_answer {
  std::optional<pass_reviewed> reviewed;
  map_failure failure = map_failure::none;
  std::string error;
  GODWIT_FIELDS(pass_answer, "mapobjects_store.pass_answer", reviewed, failure, error);
};

// What lies on a part of the map, for people who look at it. Degrees of WGS84; times are nanoseconds since 1970 (UTC).
// Thread: plain values.
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
