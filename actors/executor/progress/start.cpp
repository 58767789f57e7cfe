#include "actors/executor/progress/start.hpp"

#include <utility>

#include "actors/executor/progress/advance.hpp"
#include "actors/executor/progress/follow.hpp"
#include "runtime/assert.hpp"

namespace godwit::executor::progress {

void take(decision_context& t, const start_intended& what) {
  GODWIT_ASSERT(t.s.plan && has_sequence(t.s.plan->map, what.sequence), "a start is at an item of the plan");
  GODWIT_ASSERT(!t.s.upload && !t.s.start, "one intent at a time");
  t.s.held.clear();
  t.s.start = what;
}

// One that is at the start of the plan is seen there anyway.
void take(decision_context& t, const found_begun& what) {
  if (!t.s.plan || t.s.paused || t.s.upload || t.s.start)
    return;
  const auto& plan = *t.s.plan;
  if (plan.generation.is_armed || !has_sequence(plan.map, what.sequence) ||
      is_start(plan.map, plan.generation.start_sequence, what.sequence))
    return;
  open_generation(t, generation_origin::start, what.sequence);
  t.s.plan->generation.was_active = what.was_incomplete;
}

void take(decision_context& t, const start_ended& what) {
  if (!t.s.start)
    return;
  const auto start = *std::exchange(t.s.start, std::nullopt);
  if (!what.is_accepted || t.s.paused == pause_reason::foreign_plan || t.s.paused == pause_reason::infeasible_plan) {
    t.s.held.clear(); // what was true then comes again if it is still true
    return;
  }
  catch_up(t);
  if (!is_way_home(t.s.plan->map))
    t.s.paused.reset();
  open_generation(t, generation_origin::start, start.sequence);
  t.s.plan->generation.was_active = start.was_incomplete;
  t.s.plan->generation.was_beyond = start.was_beyond;
  release_held(t);
}

} // namespace godwit::executor::progress
