#include "actors/mapobjects_store/sync.hpp"

namespace godwit::mapobjects_store {

sync_state next_state(sync_state now, sync_event happened, bool has_copy) {
  switch (happened) {
  case sync_event::mission_chosen:
  case sync_event::mission_deleted:
    return sync_state::fresh_boot;
  case sync_event::pull_finished:
    return sync_state::synced;
  case sync_event::pull_failed:
    return has_copy ? sync_state::degraded : sync_state::failed;
  case sync_event::fallback_acknowledged:
    return now == sync_state::degraded ? sync_state::cached_fallback : now;
  }
  return now;
}

bool shows_findings(sync_state now) { return now == sync_state::synced || now == sync_state::cached_fallback; }

} // namespace godwit::mapobjects_store
