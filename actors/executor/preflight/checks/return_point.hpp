// Fails when the return point lies outside of the inclusion fences or in an exclusion fence. Skipped without a mission
// or fences. Thread: pure.
#pragma once

#include "actors/executor/preflight/facts.hpp"
#include "actors/executor/preflight/result.hpp"
#include "actors/executor/preflight/settings.hpp"

namespace godwit::executor::preflight {

[[nodiscard]] result look_at_return_point(const facts& seen, const settings& set);

} // namespace godwit::executor::preflight
