// The rules of the flight, of the journal, of the runtime and of a scan. Thread: pure.
#pragma once

#include <memory>

#include "invariants/invariant.hpp"

namespace godwit::invariants {

// What godwit promises of a flight and its reports: docs/progress.md, docs/actors.

[[nodiscard]] std::unique_ptr<invariant> make_reports_without_gap();
[[nodiscard]] std::unique_ptr<invariant> make_complete_once();
[[nodiscard]] std::unique_ptr<invariant> make_generation_never_falls();
[[nodiscard]] std::unique_ptr<invariant> make_guarded_by_its_fences();
[[nodiscard]] std::unique_ptr<invariant> make_pilot_is_left_alone();
[[nodiscard]] std::unique_ptr<invariant> make_restart_starts_nothing();
[[nodiscard]] std::unique_ptr<invariant> make_latch_holds();

// What godwit promises of what is in its journal: docs/actors/mission_client.md and docs/architecture.md.

[[nodiscard]] std::unique_ptr<invariant> make_reports_are_kept();
[[nodiscard]] std::unique_ptr<invariant> make_outbox_numbers_once();
[[nodiscard]] std::unique_ptr<invariant> make_outbox_was_told();
[[nodiscard]] std::unique_ptr<invariant> make_given_up_is_written();

// What the runtime promises to every actor: docs/architecture.md, "Inside an actor", "A crash, step by step".

[[nodiscard]] std::unique_ptr<invariant> make_cause_before_effect();
[[nodiscard]] std::unique_ptr<invariant> make_one_handler_at_a_time();
[[nodiscard]] std::unique_ptr<invariant> make_incarnations_rise();
[[nodiscard]] std::unique_ptr<invariant> make_crash_ends_incarnation();
[[nodiscard]] std::unique_ptr<invariant> make_handled_once();

// What godwit promises of points of interest: docs/actors/scan_controller.md.

[[nodiscard]] std::unique_ptr<invariant> make_points_within_rate();
[[nodiscard]] std::unique_ptr<invariant> make_point_closed_once();

} // namespace godwit::invariants
