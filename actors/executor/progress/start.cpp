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
  const auto tried = plan.generation.tried_start;
  const bool is_ours = tried && !tried->was_beyond; // else nobody knows where it has begun
  const bool is_on_its_way =
      has_sequence(plan.map, what.sequence) && !is_start(plan.map, plan.generation.start_sequence, what.sequence);
  if (plan.generation.is_armed || !(is_on_its_way || is_ours))
    return;
  open_generation(t, generation_origin::start, is_ours ? tried->sequence : what.sequence);
  t.s.plan->generation.was_active = is_ours ? tried->was_incomplete : what.was_incomplete;
  t.s.plan->generation.was_beyond = false;
  t.s.plan->generation.is_found = true;
}

void take(decision_context& t, const start_ended& what) {
  if (!t.s.start)
    return;
  const auto start = *std::exchange(t.s.start, std::nullopt);
  if (!what.is_accepted || t.s.paused == pause_reason::foreign_plan || t.s.paused == pause_reason::infeasible_plan) {
    t.s.held.clear(); // what was true then comes again if it is still true
    if (t.s.plan)
      t.s.plan->generation.tried_start = start; // it may have been obeyed unheard
    return;
  }
  catch_up(t);
  if (!is_way_home(t.s.plan->map))
    t.s.paused.reset();
  auto never_near = std::exchange(t.s.plan->generation.never_near, {}); // of what was held back
  open_generation(t, generation_origin::start, start.sequence);
  t.s.plan->generation.was_active = start.was_incomplete;
  t.s.plan->generation.was_beyond = start.was_beyond;
  t.s.plan->generation.never_near = std::move(never_near);
  release_held(t);
}

} // namespace godwit::executor::progress
