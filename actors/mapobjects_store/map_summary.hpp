// How the map is, counted. Thread: the one of the database.
#pragma once

#include "actors/mapobjects_store/map_tables.hpp"
#include "messages/mapobjects_store/status.hpp"

namespace godwit::mapobjects_store {

// Looks at each row that is owed: some 5 ms for 50,000.
[[nodiscard]] map_result<map_status> summary(map_tables& t);

} // namespace godwit::mapobjects_store
