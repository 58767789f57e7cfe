// How a flight stands as one short text that changes whenever something changed by which a person decides: phase, cause
// of a pause, mission, its revision, the plan on the vehicle, the preflight report that waits. How far the plan is
// flown is not part of it. A command that was meant for another one is not obeyed. Pure. Thread: any.
#pragma once

#include <string>

#include "actors/executor/state.hpp"

namespace godwit::executor {

// "flying/none/7d1c1f0e-6b0c-4c55-9d0d-2f6d3c8b1a42/3/2/0"; for comparing, not for reading.
[[nodiscard]] std::string state_token(const state& s);

} // namespace godwit::executor
