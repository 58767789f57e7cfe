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
  static constexpr auto fields = io::table("mapobjects_store.view_circle", io::field("centre", &view_circle::centre),
                                           io::field("radius_m", &view_circle::radius_m));
};

struct view_polygon {
  std::vector<geo_position> vertices; // at least three
  static constexpr auto fields =
      io::table("mapobjects_store.view_polygon", io::field("vertices", &view_polygon::vertices));
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
  static constexpr auto fields = io::table(
      "mapobjects_store.pass_end", io::field("id", &pass_end::id), io::field("mission_id", &pass_end::mission_id),
      io::field("started_ns", &pass_end::started_ns), io::field("ended_ns", &pass_end::ended_ns),
      io::field("class_groups", &pass_end::class_groups), io::field("circles", &pass_end::circles),
      io::field("polygons", &pass_end::polygons), io::field("confidence", &pass_end::confidence));
};

struct pass_reviewed {
  std::string id;
  std::uint64_t in_view = 0;            // objects looked at
  std::uint64_t removed_candidates = 0; // observations of that kind, those of an earlier try included
  static constexpr auto fields = io::table("mapobjects_store.pass_reviewed", io::field("id", &pass_reviewed::id),
                                           io::field("in_view", &pass_reviewed::in_view),
                                           io::field("removed_candidates", &pass_reviewed::removed_candidates));
};

struct pass_answer {
  std::optional<pass_reviewed> reviewed;
  map_failure failure = map_failure::none;
  std::string error;
  static constexpr auto fields =
      io::table("mapobjects_store.pass_answer", io::field("reviewed", &pass_answer::reviewed),
                io::field("failure", &pass_answer::failure), io::field("error", &pass_answer::error));
};

} // namespace godwit::mapobjects_store
