// Degraded when the camera is on and not ready: the flight is as safe without pictures, and may be of no use. Skipped
// when it is off. Thread: pure.
#pragma once

#include "actors/executor/preflight/facts.hpp"
#include "actors/executor/preflight/result.hpp"
#include "actors/executor/preflight/settings.hpp"

namespace godwit::executor::preflight {

[[nodiscard]] result look_at_camera(const facts& seen, const settings& set);

} // namespace godwit::executor::preflight
