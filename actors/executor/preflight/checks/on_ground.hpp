// Fails while the vehicle is in the air or drives, and godwit has not started it: whoever flies it has a plan, and it
// is not replaced. Skipped while the vehicle is not heard. Thread: pure.
#pragma once

#include "actors/executor/preflight/facts.hpp"
#include "actors/executor/preflight/result.hpp"
#include "actors/executor/preflight/settings.hpp"

namespace godwit::executor::preflight {

[[nodiscard]] result look_at_on_ground(const facts& seen, const settings& set);

} // namespace godwit::executor::preflight
