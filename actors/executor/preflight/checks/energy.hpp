// Degraded when the battery does not last for the plan and the straight way home behind it, above the level at which
// the failsafe returns; where flights begin by themselves, and nobody could acknowledge it, above the critical level.
// By the drain of the last flight, or the one that was set. Skipped where neither is known,
// without a plan, and while the vehicle is not heard. Thread: pure.
#pragma once

#include "actors/executor/preflight/facts.hpp"
#include "actors/executor/preflight/result.hpp"
#include "actors/executor/preflight/settings.hpp"

namespace godwit::executor::preflight {

[[nodiscard]] result look_at_energy(const facts& seen, const settings& set);

} // namespace godwit::executor::preflight
