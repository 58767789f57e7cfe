// Which mission the map is for, how far it can be relied on, and what happens when a mission is deleted. What each does
// is told in messages/mapobjects_store/scope.hpp.
//
// What was pulled for another mission is not shown; it comes back when that mission does, until the next load. Thread:
// the one of the database.
#pragma once

#include "actors/mapobjects_store/map_tables.hpp"
#include "messages/mapobjects_store/scope.hpp"

namespace godwit::mapobjects_store {

[[nodiscard]] map_result<void> choose(map_tables& t, const choose_mission& asked);
[[nodiscard]] map_result<void> fall_back(map_tables& t, const pull_failed& said);
[[nodiscard]] map_result<void> accept_fallback(map_tables& t, const acknowledge_fallback& said);

// One transaction; says how many rows were orphaned.
[[nodiscard]] map_result<std::uint64_t> forget(map_tables& t, const delete_mission& said);

} // namespace godwit::mapobjects_store
