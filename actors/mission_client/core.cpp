#include "actors/mission_client/core.hpp"

#include <algorithm>

#include "actors/mission_client/decision_context.hpp"

namespace godwit::mission_client {

namespace {

// After what earlier missions left. Empty: with the next one of the service.
void begin_with(decision_context& t, const std::string& mission_id) {
  auto& s = t.s;
  s.now = phase::delivering_earlier;
  s.mission_id = mission_id;
  s.revision = 0;
  s.pull = pull_state::not_started;
  s.looks_up = false;
  s.assignments.clear();
  for (auto& each : s.rows)
    if (each.state == row_state::pending && each.mission_id != mission_id)
      each.next_try_ns = t.now_ns; // somebody waits for it now
}

void take(decision_context& t, const begin_mission& m) {
  auto& s = t.s;
  if (s.mission_id == m.mission_id && s.now != phase::idle && s.now != phase::refused)
    return;
  begin_with(t, m.mission_id);
  note_of(s, m.mission_id).is_deleted = false; // whether it still is, the service will say
}

void take(decision_context& t, const begin_next& m) {
  auto& s = t.s;
  s.vehicle_id = m.vehicle_id;
  s.over = m.over;
  if (s.over.size() > max_mission_notes)
    s.over.erase(s.over.begin(), s.over.end() - static_cast<std::ptrdiff_t>(max_mission_notes));
  const bool is_under_way = s.now != phase::idle && s.now != phase::refused;
  if (is_under_way && !is_mission_over(s, s.mission_id)) // it is the next, or that is asked for
    return;
  begin_with(t, {});
}

void take(decision_context& t, const next_given& m) {
  auto& s = t.s;
  if (s.now != phase::asking_next || is_mission_over(s, m.mission_id))
    return;
  s.now = phase::fetching;
  s.mission_id = m.mission_id;
  note_of(s, m.mission_id).is_deleted = false;
}

void take(decision_context& t, const earlier_delivered&) {
  if (t.s.now == phase::delivering_earlier)
    t.s.now = t.s.mission_id.empty() ? phase::asking_next : phase::fetching;
}

void take(decision_context& t, const mission_fetched& m) {
  auto& s = t.s;
  if (s.now != phase::fetching || s.mission_id != m.document.mission_id)
    return;
  s.now = phase::pulling;
  s.pull = pull_state::in_flight;
  auto& note = note_of(s, s.mission_id);
  note.is_deleted = false;
  std::optional<earlier_reports> earlier;
  if (m.last_report_no.value_or(0) > (note.asks_progress ? note.sure_report_no : note.service_report_no)) {
    earlier = earlier_reports{*m.last_report_no, m.last_report};
    continue_after(t, note, *earlier);
  }
  note.asks_progress = false;
  note_known_items(t, m.document);
  s.refused.reset();
  s.revision = m.document.revision;
  s.asks_after = m.document.revision;
  s.schema_version = m.document.schema_version;
  s.last_fetch_ns = t.now_ns;
  const auto last_report_no = std::max(note.last_report_no, note.service_report_no);
  t.tell(mission_loaded{load_cause::fetched, m.document, earlier, last_report_no});
}

void take(decision_context& t, const fetch_failed& m) {
  auto& s = t.s;
  if (s.now != phase::fetching || s.mission_id != m.refusal.mission_id)
    return;
  s.now = phase::refused;
  s.refused = m.refusal;
  t.tell(m.refusal);
}

void take(decision_context& t, const pull_map& m) {
  auto& s = t.s;
  if (s.now != phase::ready || s.mission_id != m.mission_id || s.pull == pull_state::in_flight)
    return;
  s.now = phase::pulling;
  s.pull = pull_state::in_flight;
}

void take(decision_context& t, const accept_copy& m) {
  if (t.s.mission_id == m.mission_id && t.s.pull == pull_state::cached_fallback)
    add_store_operation(t.s, store_operation_kind::accept_copy, m.mission_id, {});
}

void take(decision_context& t, const pull_ended& m) {
  auto& s = t.s;
  if (s.now != phase::pulling || s.mission_id != m.result.mission_id)
    return;
  s.now = phase::ready;
  s.pull = m.result.state;
  t.tell(m.result);
}

// Of a mission that is deleted nothing can be delivered.
void begin_push(mission_note& note) {
  note.is_pushing = true;
  note.seen_done = note.is_deleted;
  note.ignored_done = note.is_deleted;
}

// Said again it looks again: something may have been seen since.
void take(decision_context& t, const push_map& m) {
  auto& note = note_of(t.s, m.mission_id);
  begin_push(note);
  note.was_asked = true;
  if (note.is_deleted) // what was seen since is kept aside, too
    add_store_operation(t.s, store_operation_kind::orphan_mission, m.mission_id, std::string(mission_is_deleted));
}

void take(decision_context& t, const owed_found& m) {
  for (const auto& each : m.mission_ids)
    if (auto& note = note_of(t.s, each); !note.is_pushing)
      begin_push(note);
}

void take(decision_context& t, const mission_looked_up& m) {
  auto& s = t.s;
  if (s.mission_id != m.mission_id)
    return;
  s.looks_up = false;
  if (!m.document)
    return;
  note_known_items(t, *m.document);
  s.schema_version = m.document->schema_version;
  s.last_fetch_ns = t.now_ns;
  if (s.revision == 0 || m.document->revision <= s.revision)
    return;
  s.revision = m.document->revision;
  t.tell(mission_loaded{load_cause::looked_up, *m.document});
}

void take(decision_context& t, const assignments_seen& m) {
  auto& s = t.s;
  if (s.mission_id != m.mission_id)
    return;
  for (const auto& each : m.assignments) {
    const bool is_known = std::ranges::any_of(
        s.assignments, [&](const open_assignment& known) { return known.what.assignment_id == each.assignment_id; });
    if (is_known) {
      s.asks_after = std::max(s.asks_after, each.revision);
      continue;
    }
    if (s.assignments.size() >= max_open_assignments) {
      const auto resolved = std::ranges::find_if(s.assignments, &open_assignment::is_responded);
      if (resolved == s.assignments.end())
        return;
      s.assignments.erase(resolved);
    }
    s.asks_after = std::max(s.asks_after, each.revision);
    s.assignments.push_back({each, false});
    t.tell(assignment_arrived{m.mission_id, each});
  }
}

// What waits for this mission is kept; the vehicle flies on with what it has.
void take(decision_context& t, const mission_gone& m) {
  auto& s = t.s;
  const std::string reason(mission_is_deleted);
  const bool was_known = is_deleted(s, m.mission_id);
  give_up_all(t,
              keys_where(s,
                         [&](const outbox_row& each) {
                           return each.mission_id == m.mission_id && each.state == row_state::pending;
                         }),
              row_state::orphaned, reason);
  auto& note = note_of(s, m.mission_id);
  note.is_deleted = note.seen_done = note.ignored_done = true;
  note.asks_progress = false;
  if (s.mission_id == m.mission_id) {
    s.looks_up = false;
    if (s.now == phase::fetching) {
      s.now = phase::refused;
      s.refused = mission_refused{m.mission_id, refusal::deleted, reason, {}};
      t.tell(*s.refused);
    } else if (s.now == phase::pulling) {
      s.now = phase::ready;
      s.pull = pull_state::failed;
      t.tell(map_pulled{m.mission_id, s.pull, 0, 0, reason});
    }
  }
  if (was_known)
    return;
  add_store_operation(s, store_operation_kind::delete_mission, m.mission_id, reason);
  t.tell(mission_deleted{m.mission_id});
}

void take(decision_context& t, const store_operation_done& m) {
  const auto found = std::ranges::find_if(t.s.store_operations, [&](const store_operation& each) {
    return each.kind == m.what.kind && each.mission_id == m.what.mission_id;
  });
  if (found != t.s.store_operations.end())
    t.s.store_operations.erase(found);
}

} // namespace

std::vector<effect> durable_core::apply(state& s, const event& happened, std::int64_t now_ns) {
  decision_context t{s, now_ns};
  const auto first_order = s.next_order;
  const auto settled_before = s.resolved_rows;
  std::visit([&](const auto& m) { take(t, m); }, happened);
  resolve(t);
  const bool frees_lanes = std::holds_alternative<retry_outbox>(happened);
  if (s.next_order != first_order || frees_lanes)
    t.tell(on_disk{s.next_order, frees_lanes});
  if (s.resolved_rows / resolved_rows_per_pruning != settled_before / resolved_rows_per_pruning)
    t.tell(table_pruned{});
  return std::move(t.done);
}

std::vector<effect> durable_core::resume(const state& s, std::int64_t) {
  std::vector<effect> result;
  for (const auto& each : s.assignments)
    if (!each.is_responded)
      result.emplace_back(assignment_arrived{s.mission_id, each.what});
  return result;
}

} // namespace godwit::mission_client
