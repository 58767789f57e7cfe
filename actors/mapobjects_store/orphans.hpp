// What is owed for missions that are gone: kept aside with the reason, until a person queues it again. A batch keeps
// its key and its rows. Thread: the one of the database.
#pragma once

#include "actors/mapobjects_store/map_tables.hpp"
#include "messages/mapobjects_store/scope.hpp"

namespace godwit::mapobjects_store {

// All that is owed for the mission; the ignore list goes on working. How many rows.
[[nodiscard]] map_result<std::uint64_t> orphan(map_tables& t, const orphan_mission& asked);

// Those in no batch, back into the queue. How many rows.
[[nodiscard]] map_result<std::uint64_t> requeue(map_tables& t, const requeue_mission& asked);

} // namespace godwit::mapobjects_store
