// What every answer of mapobjects_store says beside its own: whether it was done, and if not, why. Thread: plain
// values.
#pragma once

#include <string>

#include "io/fields/field_table.hpp"

namespace godwit::mapobjects_store {

enum class map_failure {
  none,          // done, and on the disk (a load_page: beside the map, see load.hpp)
  refused,       // makes no sense as it was asked; asking again does not help
  load_given_up, // this load is not under way (any more): begin anew
  delivered,     // a batch under this key was delivered before: take the next one under a new key
  busy,          // a bound is reached; nothing was done; ask again later
  broken,        // the map's file is damaged or closed: a person has to look
};

GODWIT_ENUM_NAMES(map_failure, none, refused, load_given_up, delivered, busy, broken);

// To whatever has nothing else to tell.
struct map_answer {
  map_failure failure = map_failure::none;
  std::string error; // for people; empty = done
  GODWIT_FIELDS(map_answer, "mapobjects_store.map_answer", failure, error);
};

} // namespace godwit::mapobjects_store
