// Fails until the objects of the map are pulled. A copy from before, because the pull failed, is degraded. Skipped for
// a mission that did not come from the service. Thread: pure.
#pragma once

#include "actors/executor/preflight/facts.hpp"
#include "actors/executor/preflight/result.hpp"
#include "actors/executor/preflight/settings.hpp"

namespace godwit::executor::preflight {

[[nodiscard]] result look_at_map_objects(const facts& seen, const settings& set);

} // namespace godwit::executor::preflight
