// What the failsafe gets beforehand: the modes in which a vehicle may be seen after what follows a guard step.
//
// It answers when what it was told is on the disk. So a process that is killed right after the mode leaves one that
// knows whose it was, and takes nobody for a pilot who is none. Thread: pure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "actors/domain/flight_mode/flight_modes.hpp"
#include "actors/executor/tasks/steps.hpp"

namespace godwit::executor {

// By the first step of WAY after AT that changes the mode of a vehicle which is under way: it goes on, or holds for
// another plan. Empty: none does. A start is not among them: the failsafe knows whose a take-off in the mission mode
// is.
[[nodiscard]] std::vector<std::uint32_t> announced_modes(task_kind kind, const steps& way, std::size_t at,
                                                         const flight::mode_owner& whose);

} // namespace godwit::executor
