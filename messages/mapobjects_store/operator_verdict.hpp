// What became of something that was shown to the operator. Thread: plain values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "messages/mapobjects_store/answer.hpp"
#include "messages/mapobjects_store/object.hpp"

namespace godwit::mapobjects_store {

enum class verdict {
  confirmed,
  declined, // of no interest: the ignore list learns it
  timed_out // nobody looked: says nothing about the thing
};

GODWIT_ENUM_NAMES(verdict, confirmed, declined, timed_out);

// Answered with verdict_answer. Said again with the same id, it counts once.
struct operator_verdict {
  std::string id; // UUID; becomes the id of the ignored item
  std::string mission_id;
  std::string class_group;
  geo_position position; // of what was shown
  verdict said = verdict::timed_out;
  std::int64_t at_ns = 0;
  GODWIT_FIELDS(operator_verdict, "mapobjects_store.operator_verdict", id, mission_id, class_group, position, said,
                at_ns);
};

struct verdict_answer {
  std::optional<ignored_item> ignored; // what a decline has put on the ignore list
  map_failure failure = map_failure::none;
  std::string error;
  GODWIT_FIELDS(verdict_answer, "mapobjects_store.verdict_answer", ignored, failure, error);
};

} // namespace godwit::mapobjects_store
