// Compares the home for which a file was planned with the vehicle's. Nothing flies to the planned one; when it is far
// off, the mission may be one for another place. Thread: pure.
#pragma once

#include "actors/executor/preflight/facts.hpp"
#include "actors/executor/preflight/result.hpp"
#include "actors/executor/preflight/settings.hpp"

namespace godwit::executor::preflight {

// Ground stations take the place where the map stood, or where the vehicle stood when the plan was drawn: some ten
// metres from where it takes off are usual.
inline constexpr double far_from_planned_home_m = 100;

[[nodiscard]] result look_at_planned_home(const facts& seen, const settings& set);

} // namespace godwit::executor::preflight
