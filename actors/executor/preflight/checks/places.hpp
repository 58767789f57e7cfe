// Fails when a place of the mission lies farther from home, or higher above it, than the vehicle may be sent. Skipped
// without a mission, or while the vehicle is not heard. Thread: pure.
#pragma once

#include "actors/executor/preflight/facts.hpp"
#include "actors/executor/preflight/result.hpp"
#include "actors/executor/preflight/settings.hpp"

namespace godwit::executor::preflight {

[[nodiscard]] result look_at_places(const facts& seen, const settings& set);

} // namespace godwit::executor::preflight
