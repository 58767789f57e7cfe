#include "actors/executor/progress/advance.hpp"

#include <algorithm>
#include <utility>

#include "actors/executor/progress/acts.hpp"
#include "actors/executor/progress/patience.hpp"
#include "runtime/assert.hpp"
#include "runtime/planted_bug.hpp"

namespace godwit::executor::progress {

namespace {

using mission::progress_kind;

bool is_waiting(const generation_state& g) { return g.moved_to || g.complete_upto || g.is_reached; }

// The item where the vehicle was last is not resolved, and a REACHED of it or the last picture may still come.
bool awaits_reached(const followed_plan& plan) {
  const auto& g = plan.generation;
  const auto position = position_at(plan.map, g.current);
  return position && *position >= g.resolved && done_sequence(plan.map.items[*position]) == g.current &&
         (!g.is_reached || awaits_last_picture(plan));
}

void note_resolved(followed_plan& plan) { plan.ever_resolved = std::max(plan.ever_resolved, plan.generation.resolved); }

// Of all its places: a survey of which some lines were jumped over is not done.
bool was_never_near(const followed_plan& plan, const mapped_item& item) {
  return std::ranges::any_of(plan.generation.never_near, [&](std::uint16_t each) {
    return each >= item.first_sequence && each < item.first_sequence + item.sequence_count;
  });
}

// An act is passed, and never reached: a vehicle that goes on does not say that it was of use.
progress_kind kind_for(const mapped_item& item, progress_kind kind) {
  if (kind != progress_kind::reached || item.role == item_role::flown)
    return kind;
  return item.role == item_role::acts ? progress_kind::passed : progress_kind::skipped;
}

// The next item, as KIND. One without vehicle items is skipped whatever happens, and that is worth saying once.
void resolve_next(decision_context& t, progress_kind kind, bool is_inferred) {
  auto& plan = *t.s.plan;
  const auto& item = plan.map.items[plan.generation.resolved];
  if (kind == progress_kind::reached && was_never_near(plan, item)) {
    kind = progress_kind::skipped;
    is_inferred = false;
    tell(t, progress_event_kind::place_missed, item.item_id);
  }
  const auto resolved_as = kind_for(item, kind);
  const auto findings = take_findings(t, plan.generation.resolved, resolved_as);
  if (item.sequence_count > 0)
    report_item(t, resolved_as, item, is_inferred && !findings.outcome, findings);
  else if (plan.generation.resolved >= plan.ever_resolved)
    report_item(t, progress_kind::skipped, item, false);
  ++plan.generation.resolved;
  note_resolved(plan);
}

// By a vehicle that begins at START. What has no vehicle items stands at its beginning, and has not passed it.
bool is_jumped_over(const mapped_item& item, std::uint16_t start) {
  return item.sequence_count == 0 ? item.first_sequence < start : is_passed(item, start);
}

void resolve_passed(decision_context& t, std::uint16_t sequence) {
  const auto& plan = *t.s.plan;
  while (plan.generation.resolved < plan.map.items.size() &&
         is_passed(plan.map.items[plan.generation.resolved], sequence))
    resolve_next(t, progress_kind::reached, true);
}

void report_completion(decision_context& t, bool is_inferred) {
  auto& open = *t.s.mission;
  if (!t.s.plan->map.ends_mission || open.completed_revision == open.revision)
    return;
  open.completed_revision = open.revision;
  report_mission(t, progress_kind::complete, is_inferred);
  tell(t, progress_event_kind::mission_complete);
}

// What stands after the last movement takes no time, but for an act of which a report may come.
void finish(decision_context& t, bool is_inferred) {
  auto& plan = *t.s.plan;
  if (plan.generation.is_finished || plan.generation.resolved < items_to_finish(plan.map))
    return;
  while (plan.generation.resolved < plan.map.items.size())
    resolve_next(t, progress_kind::reached, true);
  plan.generation.is_finished = true;
  tell(t, progress_event_kind::plan_done);
  report_completion(t, is_inferred);
}

void wait_if_new(decision_context& t, bool was_waiting) {
  if (!was_waiting)
    t.s.plan->generation.waiting_since_ns = t.now_ns;
}

// All that moves the vehicle is done.
bool is_flown(const followed_plan& plan) {
  return plan.generation.resolved >= items_to_finish(plan.map) && !ends_in_loop(plan.map);
}

// It is flown, and of an act after it a report may still come.
bool awaits_last_outcome(const followed_plan& plan) {
  const auto& g = plan.generation;
  if (g.is_finished || !is_flown(plan))
    return false;
  for (auto i = g.resolved; i < plan.map.items.size(); ++i)
    if (awaits_outcome(plan, i))
      return true;
  return false;
}

void finish_or_wait(decision_context& t, bool is_inferred) {
  auto& g = t.s.plan->generation;
  if (!awaits_last_outcome(*t.s.plan))
    return finish_if_done(t, is_inferred);
  if (g.complete_upto)
    return;
  wait_if_new(t, is_waiting(g));
  g.complete_upto = static_cast<std::uint16_t>(end_sequence(t.s.plan->map) - 1);
}

// What was reached, and waited for the last picture of its line.
void resolve_reached(decision_context& t) {
  auto& g = t.s.plan->generation;
  if (std::exchange(g.is_reached, false) && position_at(t.s.plan->map, g.current) == g.resolved)
    resolve_next(t, progress_kind::reached, false);
}

void adopt_move(decision_context& t) {
  auto& g = t.s.plan->generation;
  resolve_reached(t);
  g.current = *std::exchange(g.moved_to, std::nullopt);
  resolve_passed(t, g.current);
  begin_next_pictures(g);
  finish_or_wait(t, true);
  begin(t);
}

// Items after UPTO were not flown: the vehicle was told to end earlier.
void adopt_complete(decision_context& t) {
  auto& plan = *t.s.plan;
  resolve_reached(t);
  const auto upto = *std::exchange(plan.generation.complete_upto, std::nullopt);
  const bool awaited_act = is_flown(plan);
  resolve_passed(t, static_cast<std::uint16_t>(upto + 1));
  finish(t, !awaited_act || plan.last_reached < last_movement(plan.map));
  while (plan.generation.resolved < plan.map.items.size())
    resolve_next(t, progress_kind::skipped, true);
  finish(t, true);
}

const std::string& jump_of(const decision_context& t, const plan_loop& loop) {
  const auto& map = t.s.plan->map;
  const auto position = position_at(map, loop.jump_sequence);
  GODWIT_ASSERT(position, "the jump of a loop belongs to an item of the mission");
  return map.items[*position].item_id;
}

taken_jump& count_of(decision_context& t, const plan_loop& loop) {
  auto& jumps = t.s.mission->jumps;
  const auto& id = jump_of(t, loop);
  const auto known = std::ranges::find(jumps, id, &taken_jump::item_id);
  if (known != jumps.end())
    return *known;
  if (jumps.size() == max_mapped_items) // of revisions long past
    jumps.erase(jumps.begin());
  return jumps.emplace_back(taken_jump{.item_id = id});
}

// A vehicle that forgets its count as it leaves a loop counts anew when it comes there again.
void leave_loops(decision_context& t, std::uint16_t from, std::uint16_t to) {
  for (const auto& each : t.s.plan->map.loops)
    if (each.counts_anew && from <= each.jump_sequence && each.jump_sequence < to)
      std::erase_if(t.s.mission->jumps, [&](const taken_jump& jump) { return jump.item_id == jump_of(t, each); });
}

// Of the line with which the plan begins, and that an earlier one has begun.
mission::picture_count pictures_before(const decision_context& t) {
  const auto& items = t.s.plan->map.items;
  const auto first =
      std::ranges::find_if(items, [](const mapped_item& each) { return each.last_nav_sequence.has_value(); });
  const bool continues = first != items.end() && first->continues_line && t.s.mission->line &&
                         t.s.mission->line->item_id == first->item_id;
  return continues ? t.s.mission->line->pictures : mission::picture_count();
}

} // namespace

void finish_if_done(decision_context& t, bool is_inferred) {
  if (!ends_in_loop(t.s.plan->map))
    finish(t, is_inferred);
}

void move_on(decision_context& t, std::uint16_t sequence) {
  auto& g = t.s.plan->generation;
  if (g.moved_to)
    adopt_move(t);
  GODWIT_ASSERT(sequence > g.current, "a generation goes forward");
  leave_loops(t, g.current, sequence);
  const bool was_waiting = is_waiting(g);
  g.moved_to = sequence;
  adopt_early_picture(t);
  if (awaits_reached(*t.s.plan) || awaits_outcome(*t.s.plan))
    wait_if_new(t, was_waiting);
  else
    adopt_move(t);
}

// First the vehicle has moved on to the jump, which it does not report: the REACHED before it may still come.
void go_round(decision_context& t, const plan_loop& loop, std::uint16_t sequence) {
  auto& g = t.s.plan->generation;
  if (g.moved_to.value_or(g.current) < loop.jump_sequence)
    move_on(t, loop.jump_sequence);
  if (g.moved_to && !has_waited(t))
    return;
  if (g.moved_to)
    adopt_move(t);
  const bool is_active = g.is_active;
  ++count_of(t, loop).taken;
  open_generation(t, generation_origin::round, loop.target_sequence);
  g.is_armed = true;
  g.was_active = true;
  g.is_active = is_active;
  g.current = sequence;
  g.heard_ns = t.now_ns;
  begin(t);
}

// Heard at SEQUENCE. For so long a vehicle may be silent and not have flown a round more than anybody saw.
void note_heard(decision_context& t, std::uint16_t sequence) {
  constexpr std::int64_t parts = 4;
  auto& g = t.s.plan->generation;
  const auto at = g.moved_to.value_or(g.current);
  const auto heard_ns = g.heard_ns;
  for (const auto& each : t.s.plan->map.loops) {
    const auto is_within = [&](std::uint16_t one) { return one >= each.target_sequence && one <= each.jump_sequence; };
    if (each.round_ns == 0 || !is_within(at) || !is_within(sequence))
      continue;
    if (heard_ns != 0 && is_over(heard_ns, t.now_ns, each.round_ns))
      count_of(t, each).is_certain = false;
    if (is_over(heard_ns, t.now_ns, each.round_ns / parts))
      g.heard_ns = t.now_ns;
  }
}

void arrive(decision_context& t, std::uint16_t sequence) {
  auto& plan = *t.s.plan;
  auto& g = plan.generation;
  resolve_passed(t, sequence);
  const auto position = position_at(plan.map, sequence);
  if (position && *position == g.resolved && done_sequence(plan.map.items[*position]) == sequence &&
      !awaits_outcome(plan, *position)) {
    if (sequence == g.current && awaits_last_picture(plan)) {
      wait_if_new(t, is_waiting(g));
      g.is_reached = true;
      return;
    }
    resolve_next(t, progress_kind::reached, false);
    g.is_reached = false;
    finish_or_wait(t, false);
  }
  adopt_early_picture(t);
  if (g.moved_to && !awaits_outcome(plan))
    adopt_move(t);
  if (g.complete_upto && sequence >= *g.complete_upto && !awaits_last_outcome(plan))
    adopt_complete(t);
}

void note_complete(decision_context& t, std::uint16_t sequence) {
  auto& plan = *t.s.plan;
  auto& g = plan.generation;
  if (g.is_finished || g.complete_upto)
    return;
  const auto at = g.moved_to.value_or(g.current);
  const bool is_put_back = sequence < at; // ArduPilot, when it disarms: only one that has run to its end
  const bool is_proof = is_put_back && !plan.vehicle_plan_id;
  if (std::max(at, sequence) < last_movement(plan.map).value_or(0) && !is_proof &&
      !GODWIT_PLANTED(complete_on_foreign_landing))
    return; // PX4 says so of any landing; the plan is not done by that
  const bool was_waiting = is_waiting(g);
  g.complete_upto = is_put_back ? static_cast<std::uint16_t>(end_sequence(plan.map) - 1) : sequence;
  if (g.moved_to || awaits_reached(plan) || awaits_last_outcome(plan))
    wait_if_new(t, was_waiting);
  else
    adopt_complete(t);
}

bool has_waited(const decision_context& t) {
  const auto& plan = *t.s.plan;
  const bool may_be_confirmed = awaits_outcome(plan) || awaits_last_outcome(plan) || awaits_last_picture(plan);
  return is_over(plan.generation.waiting_since_ns, t.now_ns,
                 may_be_confirmed ? outcomes_late_ns(plan) : reached_late_ns);
}

void go_on_if_known(decision_context& t) {
  const auto& plan = *t.s.plan;
  const auto& g = plan.generation;
  if (awaits_outcome(plan))
    return;
  if (g.moved_to && !awaits_reached(plan))
    adopt_move(t);
  else if (g.is_reached && !awaits_last_picture(plan)) {
    resolve_reached(t);
    finish_or_wait(t, false);
  }
  const bool has_reached = !awaits_reached(plan) || (plan.last_reached == g.current && !awaits_last_picture(plan));
  if (g.complete_upto && !g.moved_to && has_reached && !awaits_last_outcome(plan))
    adopt_complete(t);
}

void catch_up(decision_context& t) {
  if (!t.s.plan)
    return;
  auto& g = t.s.plan->generation;
  if (g.moved_to)
    adopt_move(t);
  if (g.is_reached) {
    resolve_reached(t);
    finish_or_wait(t, false);
  }
  if (g.complete_upto)
    adopt_complete(t);
}

void begin(decision_context& t) {
  auto& plan = *t.s.plan;
  auto& g = plan.generation;
  const auto position = position_at(plan.map, g.current);
  if (!g.is_active || !position)
    return;
  resolve_passed(t, g.current);
  if (*position < g.resolved || g.started_position == position || !plan.map.items[*position].first_nav_sequence)
    return;
  g.started_position = position;
  report_item(t, progress_kind::started, plan.map.items[*position], false);
}

void open_generation(decision_context& t, generation_origin origin, std::uint16_t start,
                     const std::vector<mapped_item>& left_out) {
  auto& plan = *t.s.plan;
  const bool goes_on = origin != generation_origin::new_plan;
  const auto pictures = goes_on ? plan.generation.pictures : pictures_before(t);
  plan.generation = {.number = ++t.s.last_generation,
                     .origin = origin,
                     .start_sequence = start,
                     .resolving_since_ns = t.now_ns,
                     .moved_to = {},
                     .complete_upto = {},
                     .stale_reached = plan.vehicle_plan_id ? plan.last_reached : std::nullopt,
                     .never_near = {},
                     .started_position = {},
                     .pictures = pictures};
  for (const auto& each : left_out)
    report_item(t, progress_kind::skipped, each, false);
  auto& resolved = plan.generation.resolved;
  if (is_in_lead_in(plan.map, start))
    resolved = plan.map.items_before;
  for (; resolved < plan.map.items.size() && is_jumped_over(plan.map.items[resolved], start); ++resolved)
    if (resolved >= plan.ever_resolved)
      report_item(t, progress_kind::skipped, plan.map.items[resolved], false);
  note_resolved(plan);
  tell(t, progress_event_kind::generation_opened);
}

} // namespace godwit::executor::progress
