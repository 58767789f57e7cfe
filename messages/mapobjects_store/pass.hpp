// The end of a pass over an area: what was in view and not seen may be gone. Thread: plain values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

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

} // namespace godwit::mapobjects_store
