// Fails without a position of now from a fix in three dimensions; degraded with few satellites. A receiver that is set
// up as a base station tells where it was put and not where it is. Skipped while the vehicle is not heard. Thread:
// pure.
#pragma once

#include "actors/executor/preflight/facts.hpp"
#include "actors/executor/preflight/result.hpp"
#include "actors/executor/preflight/settings.hpp"

namespace godwit::executor::preflight {

[[nodiscard]] result look_at_position(const facts& seen, const settings& set);

} // namespace godwit::executor::preflight
