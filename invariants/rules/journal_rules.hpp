// What godwit promises of what is in its journal: docs/actors/mission_client.md and docs/architecture.md.
#pragma once

#include <memory>

#include "invariants/invariant.hpp"

namespace godwit::invariants {

[[nodiscard]] std::unique_ptr<invariant> make_reports_are_kept();
[[nodiscard]] std::unique_ptr<invariant> make_outbox_numbers_once();
[[nodiscard]] std::unique_ptr<invariant> make_outbox_was_told();
[[nodiscard]] std::unique_ptr<invariant> make_given_up_is_written();

} // namespace godwit::invariants
