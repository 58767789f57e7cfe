// Fails unless the battery is above the level at which the failsafe returns, by a margin. Degraded when the autopilot
// does not know its level: the failsafe then does not either. Skipped while the vehicle is not heard. Thread: pure.
#pragma once

#include "actors/executor/preflight/facts.hpp"
#include "actors/executor/preflight/result.hpp"
#include "actors/executor/preflight/settings.hpp"

namespace godwit::executor::preflight {

[[nodiscard]] result look_at_battery(const facts& seen, const settings& set);

} // namespace godwit::executor::preflight
