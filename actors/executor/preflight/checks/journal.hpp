// Fails when the journal can not be written, or did not pass its integrity check: a crash in flight could not be
// recovered from. Thread: pure.
#pragma once

#include "actors/executor/preflight/facts.hpp"
#include "actors/executor/preflight/result.hpp"
#include "actors/executor/preflight/settings.hpp"

namespace godwit::executor::preflight {

[[nodiscard]] result look_at_journal(const facts& seen, const settings& set);

} // namespace godwit::executor::preflight
