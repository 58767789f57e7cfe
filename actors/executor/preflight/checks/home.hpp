// Fails while the vehicle does not know its home: a failsafe that returns would have nowhere to go. Skipped while the
// vehicle is not heard. Thread: pure.
#pragma once

#include "actors/executor/preflight/facts.hpp"
#include "actors/executor/preflight/result.hpp"
#include "actors/executor/preflight/settings.hpp"

namespace godwit::executor::preflight {

[[nodiscard]] result look_at_home(const facts& seen, const settings& set);

} // namespace godwit::executor::preflight
