// Which mission the map is for, how far it can be relied on, and what happens when a mission is deleted. What each does
// is told in messages/mapobjects_store/load.hpp.
//
// What was pulled for another mission is not shown; it comes back when that mission does, until the next load. Thread:
// the one of the database.
#pragma once

#include "actors/mapobjects_store/map_tables.hpp"
#include "messages/mapobjects_store/load.hpp"
#include "messages/mapobjects_store/status.hpp"

namespace godwit::mapobjects_store {

[[nodiscard]] map_result<void> choose(map_tables& t, const choose_mission& asked);
[[nodiscard]] map_result<void> fall_back(map_tables& t, const pull_failed& said);
[[nodiscard]] map_result<void> accept_fallback(map_tables& t, const acknowledge_fallback& said);

// One transaction; says how many rows were orphaned.
[[nodiscard]] map_result<std::uint64_t> forget(map_tables& t, const delete_mission& said);

// How the sync state moves; the table is drawn in messages/mapobjects_store/status.hpp. Thread: pure.

// HAS_COPY: the map is one that the service gave for this mission.
[[nodiscard]] sync_state next_state(sync_state now, sync_event happened, bool has_copy);

// Whether differences from the map are findings. On a map that nobody vouches for all is new.
[[nodiscard]] bool shows_findings(sync_state now);

// What is owed for missions that are gone: kept aside with the reason, until a person queues it again. A batch keeps
// its key and its rows. Thread: the one of the database.

// All that is owed for the mission; the ignore list goes on working. How many rows.
[[nodiscard]] map_result<std::uint64_t> orphan(map_tables& t, const orphan_mission& asked);

// Those in no batch, back into the queue. How many rows.
[[nodiscard]] map_result<std::uint64_t> requeue(map_tables& t, const requeue_mission& asked);

} // namespace godwit::mapobjects_store
