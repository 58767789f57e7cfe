// Something that may be worth a look, from whoever recognises things. Thread: plain values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "io/fields/field_table.hpp"
#include "messages/mapobjects_store/object.hpp"

namespace godwit::scan_controller {

// Answered with candidate_answer when what comes of it is on the disk. Who hears no answer says it again: it counts
// once.
struct candidate {
  std::string id; // UUID of the sighting
  std::string mission_id;
  std::optional<std::string> object_id; // on the map
  std::string class_group;
  mapobjects_store::geo_position position;
  std::int64_t at_ns = 0; // when it was seen, since 1970 (UTC)
  double confidence = 0;  // 0..1
  bool has_moved = false; // a known object, away from its place
  bool is_known = false;  // a known object at its place: counts only for a point that is there already
  GODWIT_FIELDS(candidate, "scan_controller.candidate", id, mission_id, object_id, class_group, position, at_ns,
                confidence, has_moved, is_known);
};

enum class candidate_fate {
  opened,   // a new point of interest
  merged,   // into one that waits or is shown
  resolved, // of a point that was decided, or passed over a short while ago
  known,    // at its place, and no point
  too_old,  // seen too long ago
  no_room   // all points that wait are worth more
};

GODWIT_ENUM_NAMES(candidate_fate, opened, merged, resolved, known, too_old, no_room);

struct candidate_answer {
  candidate_fate fate = candidate_fate::known;
  std::uint64_t point = 0; // its number; 0: none
  GODWIT_FIELDS(candidate_answer, "scan_controller.candidate_answer", fate, point);
};

} // namespace godwit::scan_controller
