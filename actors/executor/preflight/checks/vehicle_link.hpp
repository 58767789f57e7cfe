// Fails unless the vehicle's heartbeats come, and it is clear which of those on the line it is. Thread: pure.
#pragma once

#include "actors/executor/preflight/facts.hpp"
#include "actors/executor/preflight/result.hpp"
#include "actors/executor/preflight/settings.hpp"

namespace godwit::executor::preflight {

[[nodiscard]] result look_at_vehicle_link(const facts& seen, const settings& set);

} // namespace godwit::executor::preflight
