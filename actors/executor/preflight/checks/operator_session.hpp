// Fails when an operator has to be there and is not. Skipped where none has to. Thread: pure.
#pragma once

#include "actors/executor/preflight/facts.hpp"
#include "actors/executor/preflight/result.hpp"
#include "actors/executor/preflight/settings.hpp"

namespace godwit::executor::preflight {

[[nodiscard]] result look_at_operator_session(const facts& seen, const settings& set);

} // namespace godwit::executor::preflight
