// Fails when the way of the mission, legs included, leaves the inclusion fences or comes into an exclusion fence.
// Skipped where there are no fences, or no plan whose way could be looked at; the check of the mission fails then.
// Thread: pure.
#pragma once

#include "actors/executor/preflight/facts.hpp"
#include "actors/executor/preflight/result.hpp"
#include "actors/executor/preflight/settings.hpp"

namespace godwit::executor::preflight {

[[nodiscard]] result look_at_fences(const facts& seen, const settings& set);

} // namespace godwit::executor::preflight
