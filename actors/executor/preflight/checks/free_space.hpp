// Fails when the disk of the journal is about to be full; degraded when it is filling, or its free space is not known.
// Thread: pure.
#pragma once

#include "actors/executor/preflight/facts.hpp"
#include "actors/executor/preflight/result.hpp"
#include "actors/executor/preflight/settings.hpp"

namespace godwit::executor::preflight {

[[nodiscard]] result look_at_free_space(const facts& seen, const settings& set);

} // namespace godwit::executor::preflight
