// What godwit promises of points of interest: docs/actors/scan_controller.md.
#pragma once

#include <memory>

#include "invariants/invariant.hpp"

namespace godwit::invariants {

[[nodiscard]] std::unique_ptr<invariant> make_points_within_rate();
[[nodiscard]] std::unique_ptr<invariant> make_point_closed_once();

} // namespace godwit::invariants
