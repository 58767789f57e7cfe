// What the runtime promises to every actor: docs/architecture.md, "Inside an actor", "A crash, step by step".
#pragma once

#include <memory>

#include "invariants/invariant.hpp"

namespace godwit::invariants {

[[nodiscard]] std::unique_ptr<invariant> make_cause_before_effect();
[[nodiscard]] std::unique_ptr<invariant> make_one_handler_at_a_time();
[[nodiscard]] std::unique_ptr<invariant> make_incarnations_rise();
[[nodiscard]] std::unique_ptr<invariant> make_crash_ends_incarnation();
[[nodiscard]] std::unique_ptr<invariant> make_handled_once();

} // namespace godwit::invariants
