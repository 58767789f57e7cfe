// How the map is. Thread: plain values.
#pragma once

#include <cstdint>
#include <string>

#include "io/fields/field_table.hpp"
#include "messages/mapobjects_store/answer.hpp"

namespace godwit::mapobjects_store {

// How far the map can be relied on. Thread: plain values.

//                            pull finished
//   [fresh_boot] ────────────────────────────────────> [synced]
//     ^      │                                          ^     │ pull failed
//     │      ├─ pull failed, no copy of this mission ─> [failed]   (also from synced and the others)
//     │      └─ pull failed, a copy is there ─────────> [degraded] ── operator acknowledges ──> [cached_fallback]
//     └── another mission is chosen, or this one is deleted: from every state
enum class sync_state { fresh_boot, synced, cached_fallback, degraded, failed };

GODWIT_ENUM_NAMES(sync_state, fresh_boot, synced, cached_fallback, degraded, failed);

enum class sync_event { mission_chosen, pull_finished, pull_failed, fallback_acknowledged, mission_deleted };

// Answered with map_status.
struct get_map {
  static constexpr auto fields = io::table("mapobjects_store.get_map");
};

struct map_status {
  std::string mission_id; // chosen; empty = none
  sync_state sync = sync_state::fresh_boot;
  std::string pulled_mission_id; // what the last load was for; empty = there was none
  std::int64_t pulled_ns = 0;    // when it was complete, since 1970 (UTC)
  std::uint64_t objects = 0;     // of the last load
  std::uint64_t ignored_items = 0;
  std::uint64_t seen_here = 0; // objects that this vehicle has found or moved since
  std::int64_t loading = 0;    // number of the load that is under way; 0 = none
  std::uint64_t pending = 0;   // rows owed, of all missions together
  std::uint64_t taken = 0;
  std::uint64_t orphaned = 0;
  map_failure failure = map_failure::none;
  std::string error;
  GODWIT_FIELDS(map_status, "mapobjects_store.map_status", mission_id, sync, pulled_mission_id, pulled_ns, objects,
                ignored_items, seen_here, loading, pending, taken, orphaned, failure, error);
};

} // namespace godwit::mapobjects_store
