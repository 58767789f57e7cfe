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

constexpr auto enum_names(map_failure) {
  return io::names<map_failure>({{map_failure::none, "none"},
                                 {map_failure::refused, "refused"},
                                 {map_failure::load_given_up, "load_given_up"},
                                 {map_failure::delivered, "delivered"},
                                 {map_failure::busy, "busy"},
                                 {map_failure::broken, "broken"}});
}

// To whatever has nothing else to tell.
struct map_answer {
  map_failure failure = map_failure::none;
  std::string error; // for people; empty = done
  static constexpr auto fields = io::table("mapobjects_store.map_answer", io::field("failure", &map_answer::failure),
                                           io::field("error", &map_answer::error));
};

} // namespace godwit::mapobjects_store
