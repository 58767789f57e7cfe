// What of the map people are shown of a part of it: the newest objects, and how many there are.
//
// At most max_counted_objects of those that were pulled are looked at, and as many of those that were seen here,
// whatever the map has: it is asked in the thread that writes. Thread: the one of the database.
#pragma once

#include "actors/mapobjects_store/map_tables.hpp"
#include "messages/mapobjects_store/shown.hpp"

namespace godwit::mapobjects_store {

struct objects_found {
  std::vector<shown_object> list;
  std::uint64_t counted = 0;
  bool is_all = true;
};

[[nodiscard]] map_result<objects_found> look_at_objects(map_tables& t, const get_objects& asked);

} // namespace godwit::mapobjects_store
