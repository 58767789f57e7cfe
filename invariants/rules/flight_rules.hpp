// What godwit promises of a flight and its reports: docs/progress.md, docs/actors.
#pragma once

#include <memory>

#include "invariants/invariant.hpp"

namespace godwit::invariants {

[[nodiscard]] std::unique_ptr<invariant> make_reports_without_gap();
[[nodiscard]] std::unique_ptr<invariant> make_complete_once();
[[nodiscard]] std::unique_ptr<invariant> make_generation_never_falls();
[[nodiscard]] std::unique_ptr<invariant> make_guarded_by_its_fences();
[[nodiscard]] std::unique_ptr<invariant> make_pilot_is_left_alone();
[[nodiscard]] std::unique_ptr<invariant> make_restart_starts_nothing();
[[nodiscard]] std::unique_ptr<invariant> make_latch_holds();

} // namespace godwit::invariants
