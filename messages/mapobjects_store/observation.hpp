// What was seen, and what that means for the map. Thread: plain values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "messages/mapobjects_store/answer.hpp"
#include "messages/mapobjects_store/object.hpp"

namespace godwit::mapobjects_store {

// Something was recognised. Answered with sighting_answer. Who hears no answer says it again with the same id: it
// counts once.
struct sighting {
  std::string id; // UUID, made by whoever saw it; becomes the id of the observation
  std::string mission_id;
  std::string class_group;
  geo_position position;
  std::int64_t at_ns = 0;
  double confidence = 0; // 0..1
  GODWIT_FIELDS(sighting, "mapobjects_store.sighting", id, mission_id, class_group, position, at_ns, confidence);
};

enum class observation_kind {
  found,             // nothing of this class group was known within reach
  moved,             // a known object, farther from its place than it may stray
  existing,          // a known object at its place
  ignored,           // of no interest by the ignore list
  removed_candidate, // was in view during a whole pass and not seen
};

constexpr auto enum_names(observation_kind) {
  return io::names<observation_kind>({{observation_kind::found, "new"},
                                      {observation_kind::moved, "moved"},
                                      {observation_kind::existing, "existing"},
                                      {observation_kind::ignored, "ignored"},
                                      {observation_kind::removed_candidate, "removed_candidate"}});
}

// One for each sighting, and one for each object that a pass missed. Delivered to the missions service.
struct observation {
  std::string id; // known to the service too: a row that comes again is a repetition
  std::string mission_id;
  std::optional<std::string> object_id; // a new object has the id of the observation that found it
  observation_kind kind = observation_kind::found;
  std::string class_group;
  geo_position position;
  std::int64_t at_ns = 0;
  double confidence = 0;
  GODWIT_FIELDS(observation, "mapobjects_store.observation", id, mission_id, object_id, kind, class_group, position,
                at_ns, confidence);
};

// What a sighting has become.
struct observed {
  observation what;
  bool shown = false; // a finding for the operator; false while the map is not to be relied on
  GODWIT_FIELDS(observed, "mapobjects_store.observed", what, shown);
};

// Given when the observation is on the disk.
struct sighting_answer {
  std::optional<observed> seen; // nothing when it was not taken
  map_failure failure = map_failure::none;
  std::string error;
  GODWIT_FIELDS(sighting_answer, "mapobjects_store.sighting_answer", seen, failure, error);
};

} // namespace godwit::mapobjects_store
