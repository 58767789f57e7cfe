// How the sync state moves; the table is drawn in messages/mapobjects_store/sync_state.hpp. Thread: pure.
#pragma once

#include "messages/mapobjects_store/sync_state.hpp"

namespace godwit::mapobjects_store {

// HAS_COPY: the map is one that the service gave for this mission.
[[nodiscard]] sync_state next_state(sync_state now, sync_event happened, bool has_copy);

// Whether differences from the map are findings. On a map that nobody vouches for all is new.
[[nodiscard]] bool shows_findings(sync_state now);

} // namespace godwit::mapobjects_store
