// Fails while the wall clock shows a date before the configured one: it was never set, and reports, certificates and
// signed links go by it. Thread: pure.
#pragma once

#include "actors/executor/preflight/facts.hpp"
#include "actors/executor/preflight/result.hpp"
#include "actors/executor/preflight/settings.hpp"

namespace godwit::executor::preflight {

[[nodiscard]] result look_at_wall_clock(const facts& seen, const settings& set);

} // namespace godwit::executor::preflight
