#include "actors/executor/progress/follow.hpp"

#include <algorithm>
#include <utility>

#include "actors/executor/progress/advance.hpp"
#include "actors/executor/progress/core.hpp"
#include "actors/executor/progress/patience.hpp"
#include "actors/executor/progress/plan_match.hpp"
#include "io/mavlink/enums.hpp"
#include "runtime/planted_bug.hpp"

namespace godwit::executor::progress {

namespace {

using io::mavlink::mission_current;

bool is_resolving(const decision_context& t) {
  return !is_over(t.s.plan->generation.resolving_since_ns, t.now_ns, settling_ns) &&
         !GODWIT_PLANTED(believe_late_frame) && !GODWIT_PLANTED(old_plans_progress);
}

void hold(decision_context& t, const mission_current& message) {
  auto& held = t.s.held;
  if (std::any_of(held.begin(), held.end(), [&](const auto& each) { return io::equal(each, message); }))
    return;
  if (held.size() < max_held)
    held.push_back(message);
  else
    ++t.s.dropped_held;
}

bool says_complete(const mission_current& message) {
  return message.mission_state == io::mavlink::number(io::mavlink::mission_state::complete);
}

// Where commands stand in front, a vehicle is seen after them, but not when it may have come there otherwise: it goes
// on in a plan with the same content, says with its old sequence that the old plan is complete, or says in a late
// message without an id where it was in the old plan.
bool is_at_start(const decision_context& t, const mission_current& message) {
  if (GODWIT_PLANTED(old_plans_progress))
    return true;
  const auto& plan = *t.s.plan;
  const auto& g = plan.generation;
  if (g.origin == generation_origin::same_plan)
    return message.seq == g.start_sequence && !is_resolving(t);
  if (message.seq == g.start_sequence)
    return true;
  const bool may_be_older = g.origin == generation_origin::new_plan && !plan.vehicle_plan_id && is_resolving(t);
  return is_start(plan.map, g.start_sequence, message.seq) && !says_complete(message) && !may_be_older;
}

// It has begun where it was to begin, and gone on from there before anybody heard of it: where the line was cut.
bool has_begun_unheard(const decision_context& t, const mission_current& message) {
  const auto& plan = *t.s.plan;
  const auto& g = plan.generation;
  return g.origin == generation_origin::start && !g.was_beyond && !t.s.start && !is_resolving(t) &&
         has_sequence(plan.map, message.seq) && message.seq > g.start_sequence;
}

// Armed from now on, if this is the start.
void try_to_arm(decision_context& t, const mission_current& message) {
  auto& plan = *t.s.plan;
  auto& g = plan.generation;
  if (has_begun_unheard(t, message)) {
    g.is_armed = true;
    g.current = g.start_sequence;
    tell(t, progress_event_kind::armed);
  } else if (is_at_start(t, message)) {
    if (!is_resolving(t))
      g.resolving_since_ns = t.now_ns; // it has just come there from elsewhere
    g.is_armed = true;
    g.current = message.seq;
    if (!plan.vehicle_plan_id && message.mission_id != 0)
      plan.vehicle_plan_id = message.mission_id;
    tell(t, progress_event_kind::armed);
  } else if (!g.is_found && !g.is_not_at_start_told && !is_resolving(t) && !t.s.start &&
             has_sequence(plan.map, message.seq)) {
    g.is_not_at_start_told = true;
    tell(t, progress_event_kind::not_at_start,
         "the vehicle is at item " + std::to_string(message.seq) + " of the plan and not at its start, item " +
             std::to_string(g.start_sequence));
  }
}

void note_mission_state(generation_state& g, const mission_current& message) {
  using io::mavlink::mission_state;
  g.is_active = message.mission_state == io::mavlink::number(mission_state::active);
  g.is_complete = says_complete(message);
  g.was_active = g.was_active || g.is_active;
}

// While it resolves: whether it is seen at its start, or nearer to it than it was when it was armed, which was by the
// sequence of the plan before then.
bool is_still_at_start(decision_context& t, const mission_current& message) {
  auto& g = t.s.plan->generation;
  if (!is_start(t.s.plan->map, g.start_sequence, message.seq) || message.seq > g.current)
    return false;
  if (!g.started_position)
    g.current = message.seq;
  return message.seq == g.current;
}

// Back over a jump of the plan. Where the track contradicts what it would have flown until the jump, somebody has moved
// it. While an upload or a start is under way nothing is opened: where the vehicle is comes again after that.
std::optional<plan_loop> round_begun(const decision_context& t, std::uint16_t at, std::uint16_t sequence) {
  const auto& plan = *t.s.plan;
  if (t.s.upload || t.s.start || !plan.generation.never_near.empty())
    return std::nullopt;
  return loop_between(plan.map, at, sequence);
}

void follow_armed(decision_context& t, const mission_current& message) {
  auto& plan = *t.s.plan;
  auto& g = plan.generation;
  const bool is_in_plan = has_sequence(plan.map, message.seq);
  if (is_resolving(t) && !is_still_at_start(t, message))
    return;
  note_mission_state(g, message);
  note_heard(t, message.seq);
  if (has_waited(t))
    catch_up(t);
  const auto at = g.moved_to.value_or(g.current);
  if (is_in_plan && message.seq > at)
    move_on(t, message.seq);
  else if (const auto loop = round_begun(t, at, message.seq))
    go_round(t, *loop, message.seq);
  if (g.was_active && !is_resolving(t) && g.is_complete)
    note_complete(t, message.seq);
  if (!g.moved_to)
    begin(t);
}

// Whose plan the vehicle holds.
plan_match look_for_foreign(decision_context& t, const mission_current& message) {
  const auto whose = match_of(message, *t.s.plan);
  if (whose == plan_match::other && !is_resolving(t))
    pause(t, pause_reason::foreign_plan);
  else if (whose == plan_match::infeasible && !is_resolving(t))
    pause(t, pause_reason::infeasible_plan);
  return whose;
}

void follow(decision_context& t, const mission_current& message) {
  if (!t.s.plan || t.s.paused)
    return;
  const auto& plan = *t.s.plan;
  const auto whose = look_for_foreign(t, message);
  if (whose != plan_match::ours || message.seq >= end_sequence(plan.map))
    return;
  if (!plan.generation.is_armed)
    try_to_arm(t, message);
  if (plan.generation.is_armed)
    follow_armed(t, message);
}

// Just after a new plan came it may be of the one before.
void note_reached(decision_context& t, std::uint16_t sequence) {
  if (!t.s.plan)
    return;
  auto& g = t.s.plan->generation;
  if (g.origin != generation_origin::new_plan || !is_resolving(t))
    t.s.plan->last_reached = sequence;
  if (g.stale_reached != sequence && !is_resolving(t))
    g.stale_reached.reset();
}

// Who has completed the mission before, and begins nothing, may still say what it reached then.
bool may_be_older(const generation_state& g, std::uint16_t sequence) {
  return sequence == g.stale_reached || (g.origin != generation_origin::new_plan && g.is_complete && !g.was_active);
}

bool counts(const decision_context& t, std::uint16_t sequence) {
  if (!t.s.plan || t.s.paused || !t.s.plan->generation.is_armed || is_resolving(t))
    return false;
  const auto& g = t.s.plan->generation;
  return !may_be_older(g, sequence) && sequence >= g.current && sequence <= g.moved_to.value_or(g.current);
}

void arrive_if_it_counts(decision_context& t, std::uint16_t sequence) {
  if (counts(t, sequence))
    arrive(t, sequence);
}

void follow_during_upload(decision_context& t, const mission_current& message) {
  if (may_be_uploaded(message, *t.s.upload)) {
    t.s.upload->unconfirmed_reached.reset();
    hold(t, message);
    return;
  }
  if (message.mission_id == 0)
    return; // without ids: held in place; with ids: it does not say of which plan
  if (const auto reached = std::exchange(t.s.upload->unconfirmed_reached, std::nullopt))
    arrive_if_it_counts(t, *reached);
  follow(t, message);
}

// What may be seen of a start before its answer comes: all but what can only be the progress before it.
bool may_be_started(const decision_context& t, const mission_current& message) {
  return t.s.start && t.s.plan && (!t.s.plan->generation.is_armed || message.seq >= t.s.start->sequence);
}

} // namespace

// A vehicle that stands begins nothing: what it says then counts for a plan that it has flown.
void take(decision_context& t, const current_told& what) {
  if (t.s.plan)
    t.s.plan->generation.never_near = what.never_near;
  const bool has_begun = t.s.plan && t.s.plan->generation.is_armed;
  if (!what.is_ours || (what.is_disarmed && !has_begun)) {
    if (t.s.plan && !t.s.paused && !t.s.upload && !t.s.start)
      static_cast<void>(look_for_foreign(t, what.message));
  } else if (t.s.upload)
    follow_during_upload(t, what.message);
  else if (may_be_started(t, what.message))
    hold(t, what.message);
  else
    follow(t, what.message);
  if (what.is_disarmed && !t.s.upload && t.s.plan && t.s.plan->generation.complete_upto)
    catch_up(t); // no REACHED comes of a vehicle that stands
}

void take(decision_context& t, const reached_told& what) {
  if (t.s.plan)
    t.s.plan->generation.never_near = what.never_near;
  note_reached(t, what.sequence);
  if (t.s.start && !t.s.held.empty() && what.sequence >= t.s.start->sequence)
    return; // the vehicle seems to have begun there already
  const bool has_ids = t.s.plan && t.s.plan->vehicle_plan_id;
  if (!t.s.upload || !has_ids)
    arrive_if_it_counts(t, what.sequence);
  else if (t.s.held.empty() && counts(t, what.sequence))
    t.s.upload->unconfirmed_reached = what.sequence;
}

void take(decision_context& t, const came_down&) {
  if (!is_at_last_movement(t.s) || t.s.upload || t.s.start)
    return;
  note_complete(t, static_cast<std::uint16_t>(end_sequence(t.s.plan->map) - 1));
  catch_up(t);
}

void take(decision_context& t, const other_plan_found&) {
  if (t.s.plan && !t.s.paused && !t.s.upload)
    pause(t, pause_reason::foreign_plan);
}

void take(decision_context& t, const vehicle_rebooted&) {
  t.s.held.clear();
  if (t.s.upload)
    t.s.upload->unconfirmed_reached.reset();
  if (t.s.plan)
    t.s.plan->last_reached.reset();
  t.s.last_picture.reset(); // it counts anew
  const bool is_paused_otherwise = t.s.paused && t.s.paused != pause_reason::vehicle_restarted &&
                                   t.s.paused != pause_reason::infeasible_plan; // it has not judged it yet
  if (t.s.plan && !is_paused_otherwise)
    pause(t, pause_reason::vehicle_restarted);
}

void release_held(decision_context& t) {
  for (const auto& each : std::exchange(t.s.held, {}))
    follow(t, each);
}

void pause(decision_context& t, pause_reason why) {
  catch_up(t);
  if (t.s.plan)
    t.s.plan->generation.is_armed = false;
  t.s.paused = why;
  if (why == pause_reason::foreign_plan)
    tell(t, progress_event_kind::foreign_plan, "the vehicle holds a plan that was not uploaded by this computer");
  else if (why == pause_reason::infeasible_plan)
    tell(t, progress_event_kind::infeasible_plan, "the vehicle finds that the plan can not be flown");
  else if (why == pause_reason::vehicle_restarted)
    tell(t, progress_event_kind::vehicle_restarted,
         "the autopilot has started again: the mission has to be started anew");
}

} // namespace godwit::executor::progress
