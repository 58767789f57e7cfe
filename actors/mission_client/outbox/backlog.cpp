#include "actors/mission_client/outbox/backlog.hpp"

#include <algorithm>
#include <array>

#include "actors/mission_client/outbox/deliveries.hpp"

namespace godwit::mission_client {

namespace {

constexpr const char* kind = "asking the map store for pending deliveries";
constexpr const char* store_operation_kind_text = "telling the map store about missions";

destination destination_of(store::destination to) {
  return to == store::destination::observations ? destination::observations : destination::ignored_items;
}

} // namespace

void backlog::plan(planning_context& d) {
  const auto waits_for = d.s.now == phase::delivering_earlier ? std::optional(d.s.mission_id) : std::nullopt;
  if (waits_for != std::exchange(waits_for_, waits_for) && waits_for) {
    attempt_.forget(d);
    stage_ = stage::batches;
    lanes_.count_anew();
  }
  if (stage_ != stage::looked && attempt_.may_start(d))
    attempt_.waiting = stage_ == stage::batches ? d.ask(*this, store::get_batches{}) : d.ask(*this, store::get_owed{});
  if (stage_ == stage::looked && waits_for_ && is_over(d))
    d.happened(earlier_delivered{});
}

void backlog::on_store(planning_context& d, ticket number, const store_answer& answer) {
  if (!attempt_.ends_with(number))
    return;
  if (failure_of(answer) != store::map_failure::none) {
    attempt_.fail(d, kind);
    d.went_wrong(kind, sentence_of(answer));
    if (attempt_.failed >= static_cast<std::uint32_t>(d.set.max_tries)) { // the pull will say it too
      stage_ = stage::looked;
      attempt_.succeed();
    }
    return;
  }
  attempt_.succeed();
  if (const auto* batches = std::get_if<store::open_batches>(&answer)) {
    stage_ = stage::owed;
    return take(d, *batches);
  }
  stage_ = stage::looked;
  d.went_well(kind);
  if (const auto* owed = std::get_if<store::owed_list>(&answer))
    take(d, *owed);
}

void backlog::take(planning_context& d, const store::open_batches& found) {
  for (const auto& each : found.batches)
    if (!each.orphaned && find_row(d.s.rows, each.key) == nullptr)
      d.happened(batch_planned{each.key, each.mission_id, destination_of(each.to)});
}

// Of the mission that is flown nothing is delivered before somebody says push_map; but what had to be given up of it
// is, when a person has queued it again.
void backlog::take(planning_context& d, const store::owed_list& found) {
  owed_found result;
  for (const auto& each : found.missions) {
    const auto* note = find_note(d.s, each.mission_id);
    const bool has_ended = note != nullptr && (note->seen_done || note->ignored_done);
    const bool is_known = std::ranges::find(result.mission_ids, each.mission_id) != result.mission_ids.end();
    if ((each.mission_id != d.s.mission_id || has_ended) && each.pending + each.taken != 0 && !is_known)
      result.mission_ids.push_back(each.mission_id);
  }
  if (!result.mission_ids.empty())
    d.happened(std::move(result));
}

bool backlog::is_over(planning_context& d) const {
  for (const auto& each : d.s.rows) {
    if (each.state != row_state::pending || each.mission_id == d.s.mission_id)
      continue;
    const bool is_far =
        !is_due(each.next_try_ns, d.now.wall_ns) && each.next_try_ns - d.now.wall_ns > longest_wait_for_earlier_ns;
    if (!is_far && !lanes_.has_tried_enough(each.to, each.mission_id, d.set.max_tries))
      return false;
  }
  if (is_full(d.s.rows)) // for a batch there is no room
    return true;
  return std::ranges::all_of(d.s.missions, [&](const mission_note& note) {
    if (!note.is_pushing || note.mission_id == d.s.mission_id)
      return true;
    return std::ranges::all_of(std::array{destination::observations, destination::ignored_items}, [&](destination to) {
      return note.is_done(to) || is_waiting(d.s.rows, to, note.mission_id); // looked at above
    });
  });
}

// -- store_operations --------------------------------------------------------------------------------------

void store_operations::plan(planning_context& d) {
  if (d.s.store_operations.empty() || !attempt_.may_start(d))
    return;
  current_ = d.s.store_operations.front();
  store_question asked;
  switch (current_.kind) {
  case store_operation_kind::delete_mission:
    asked = store::delete_mission{current_.mission_id, d.now.wall_ns, current_.reason};
    break;
  case store_operation_kind::orphan_mission:
    asked = store::orphan_mission{current_.mission_id, d.now.wall_ns, current_.reason};
    break;
  case store_operation_kind::requeue_mission:
    asked = store::requeue_mission{current_.mission_id};
    break;
  case store_operation_kind::accept_copy:
    asked = store::acknowledge_fallback{current_.mission_id};
    break;
  }
  attempt_.waiting = d.ask(*this, std::move(asked));
}

void store_operations::on_store(planning_context& d, ticket number, const store_answer& answer) {
  if (!attempt_.ends_with(number))
    return;
  const auto failure = failure_of(answer);
  if (failure == store::map_failure::busy || failure == store::map_failure::broken) {
    attempt_.fail(d, current_.mission_id);
    return d.went_wrong(store_operation_kind_text, sentence_of(answer));
  }
  attempt_.succeed();
  d.went_well(store_operation_kind_text);
  d.happened(store_operation_done{current_});
  if (current_.kind == store_operation_kind::requeue_mission)
    after_.look_again();
}

} // namespace godwit::mission_client
