// Fails unless every actor runs: one that was given up does not come back by itself. Thread: pure.
#pragma once

#include "actors/executor/preflight/facts.hpp"
#include "actors/executor/preflight/result.hpp"
#include "actors/executor/preflight/settings.hpp"

namespace godwit::executor::preflight {

[[nodiscard]] result look_at_actors(const facts& seen, const settings& set);

} // namespace godwit::executor::preflight
