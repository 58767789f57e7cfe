// How far the map can be relied on. Thread: plain values.
#pragma once

#include "io/fields/field_table.hpp"

namespace godwit::mapobjects_store {

//                            pull finished
//   [fresh_boot] ────────────────────────────────────> [synced]
//     ^      │                                          ^     │ pull failed
//     │      ├─ pull failed, no copy of this mission ─> [failed]   (also from synced and the others)
//     │      └─ pull failed, a copy is there ─────────> [degraded] ── operator acknowledges ──> [cached_fallback]
//     └── another mission is chosen, or this one is deleted: from every state
enum class sync_state { fresh_boot, synced, cached_fallback, degraded, failed };

GODWIT_ENUM_NAMES(sync_state, fresh_boot, synced, cached_fallback, degraded, failed);

enum class sync_event { mission_chosen, pull_finished, pull_failed, fallback_acknowledged, mission_deleted };

} // namespace godwit::mapobjects_store
