// Of a rest of a mission that begins within a loop: where the loop begins, and whether it is known how often it was
// flown. Thread: pure.
//
//   mission      up  a  b  c  jump to a, 3 times  d        c is next, and the jump was taken once
//   on the       [lead-in: take-off, what was set]  jump to c, once   a  b  c   jump to a, 2 times   d
//   vehicle                                          └───────────────────^
#pragma once

#include <cstddef>
#include <optional>

#include "actors/executor/plan/builder.hpp"

namespace godwit::executor::plan {

// The first item that the vehicle comes back to after item FROM: FROM itself, or the target of a jump that leads back
// over it, or of one of those that come after that target. A landing in between ends the search: no plan has both.
[[nodiscard]] std::size_t loop_begin(const mission::document& mission, std::size_t from);

// The jump after item BEGIN whose rounds left are not known. Nothing: all are.
[[nodiscard]] std::optional<plan_error> uncounted_jump(const mission::document& mission, std::size_t begin,
                                                       const plan_from& from, const plan_setting& setting);

// Why the jump at INDEX can not be flown in a rest from item FROM on: it leads over a landing, or was taken nobody
// knows how often.
[[nodiscard]] plan_error jump_left_out(const mission::document& mission, std::size_t from, std::size_t index);

} // namespace godwit::executor::plan
