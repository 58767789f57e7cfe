// A sighting becomes an observation, and changes the map. Thread: the one of the database.
#pragma once

#include "actors/mapobjects_store/map_tables.hpp"
#include "messages/mapobjects_store/observation.hpp"

namespace godwit::mapobjects_store {

// Said again with the same id, the answer is the same and nothing changes.
[[nodiscard]] map_result<observed> record(map_tables& t, const sighting& seen);

} // namespace godwit::mapobjects_store
