#include "actors/executor/progress/upload.hpp"

#include <utility>

#include "actors/executor/progress/cut_over.hpp"
#include "actors/executor/progress/follow.hpp"
#include "runtime/assert.hpp"
#include "runtime/planted_bug.hpp"

namespace godwit::executor::progress {

namespace {

constexpr const char* another_plan = "the vehicle holds another plan";
constexpr const char* not_come = "the plan did not come to the vehicle";

void answer_rejected(decision_context& t, const assignment_key& key, const std::string& reason) {
  t.out.emplace_back(assignment_answered{.mission_id = t.s.mission->mission_id,
                                         .assignment_id = key.assignment_id,
                                         .response = {.idempotency_key = key.idempotency_key,
                                                      .outcome = mission::assignment_outcome::rejected,
                                                      .reason = reason,
                                                      .last_progress = t.s.mission->last_report,
                                                      .generation = t.s.last_generation}});
}

// The vehicle has never left the old plan, so what it said meanwhile was of that one; a MISSION_CURRENT with another id
// comes again if it is true.
void fail(decision_context& t, const std::string& reason, bool is_tried_again = false) {
  const auto upload = *std::exchange(t.s.upload, std::nullopt);
  t.s.held.clear();
  if (upload.unconfirmed_reached)
    take(t, reached_told{*upload.unconfirmed_reached});
  if (upload.intent.assignment && !is_tried_again)
    answer_rejected(t, *upload.intent.assignment, reason);
  tell(t, progress_event_kind::upload_failed, reason);
}

// The vehicle does not hold the plan before any more.
void fail_and_pause(decision_context& t, pause_reason why, const std::string& reason, bool is_tried_again = false) {
  t.s.upload->unconfirmed_reached.reset();
  fail(t, reason, is_tried_again);
  pause(t, why);
}

// The same id can also mean that the new plan has the same content. One of another length has not.
bool is_surely_unchanged(const state& s) {
  const auto& upload = *s.upload;
  return upload.id_seen && upload.id_seen == upload.intent.id_before && s.plan &&
         s.plan->vehicle_plan_id == upload.id_seen && s.plan->map.total != upload.intent.map.total;
}

} // namespace

void take(decision_context& t, const upload_intended& what) {
  GODWIT_ASSERT(t.s.mission, "a plan is uploaded for an open mission");
  GODWIT_ASSERT(!t.s.upload && !t.s.start, "one intent at a time");
  GODWIT_ASSERT(is_sound(what.map), "a plan that is uploaded has a sound map");
  t.s.held.clear();
  t.s.upload =
      pending_upload{.generation = t.s.last_generation + 1, .intent = what, .id_seen = {}, .unconfirmed_reached = {}};
  if (what.id_before == 0U)
    t.s.upload->intent.id_before.reset();
  if (GODWIT_PLANTED(swap_cut_over))
    cut_over(t, std::nullopt);
}

void take(decision_context& t, const upload_ended& what) {
  if (!t.s.upload)
    return;
  switch (what.verdict) {
  case upload_verdict::accepted:
    return cut_over(t, what.plan_id);
  case upload_verdict::unchanged:
    return fail(t, what.reason);
  case upload_verdict::other:
    return fail_and_pause(t, pause_reason::foreign_plan, what.reason.empty() ? another_plan : what.reason);
  case upload_verdict::infeasible:
    return fail_and_pause(t, pause_reason::infeasible_plan, what.reason);
  case upload_verdict::unknown:
    t.out.emplace_back(look_at_vehicle{});
  }
}

void take(decision_context& t, const vehicle_looked_at& what) {
  if (!t.s.upload)
    return;
  t.s.upload->id_seen = what.plan_id == 0U ? std::nullopt : what.plan_id;
  if (is_surely_unchanged(t.s))
    fail(t, not_come, what.is_tried_again);
  else
    t.out.emplace_back(read_plan_back{});
}

void take(decision_context& t, const plan_read_back& what) {
  if (!t.s.upload)
    return;
  switch (what.match) {
  case read_back_match::pending:
    return cut_over(t, t.s.upload->id_seen);
  case read_back_match::before:
    return fail(t, not_come, what.is_tried_again);
  case read_back_match::other:
    return fail_and_pause(t, pause_reason::foreign_plan, another_plan, what.is_tried_again);
  }
}

} // namespace godwit::executor::progress
