// Fails unless it is known what the vehicle is and whose autopilot it has: modes, failsafes and plans depend on both. A
// generic autopilot is known: it is taken by the MAVLink text. Skipped while the vehicle is not heard. Thread: pure.
#pragma once

#include "actors/executor/preflight/facts.hpp"
#include "actors/executor/preflight/result.hpp"
#include "actors/executor/preflight/settings.hpp"

namespace godwit::executor::preflight {

[[nodiscard]] result look_at_vehicle_kind(const facts& seen, const settings& set);

} // namespace godwit::executor::preflight
