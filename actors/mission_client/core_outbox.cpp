// How rows come into the outbox, wait there, and leave it.
#include <algorithm>
#include <unordered_set>
#include <utility>

#include "actors/domain/mission/utc_text.hpp"
#include "actors/domain/mission/version.hpp"
#include "actors/domain/mission/write.hpp"
#include "actors/mission_client/decision_context.hpp"
#include "actors/mission_client/outbox/keys.hpp"
#include "actors/mission_client/retry_policy.hpp"
#include "messages/mission/map_objects.hpp"
#include "runtime/planted_bug.hpp"

namespace godwit::mission_client {

namespace {

// The service has the outcome: the assignment is not open any more.
void close_assignment(state& s, const outbox_row& row) {
  if (row.to == destination::assignment_response)
    std::erase_if(s.assignments, [&](const open_assignment& each) { return each.what.assignment_id == row.subject; });
}

// ROWS leave the outbox; what is removed at once moves what stays only once.
void remove_rows(decision_context& t, const std::vector<std::string>& keys, noted_as how) {
  std::unordered_set<std::string_view> leaving(keys.begin(), keys.end());
  if (GODWIT_PLANTED(lose_outbox_row) && t.s.rows.size() > keys.size())
    leaving.insert(t.s.rows[keys.size()].key);
  std::erase_if(t.s.rows, [&](const outbox_row& each) {
    if (!leaving.contains(each.key))
      return false;
    ++t.s.resolved_rows;
    if (each.to != destination::progress) // a report is known by its number
      remember(t.s, each.is_flown ? flown_key(each.key) : each.key);
    close_assignment(t.s, each);
    t.tell(row_noted{each, how});
    return true;
  });
}

void expire_or_wait(decision_context& t, const std::vector<outbox_row*>& failed, std::int64_t retry_after_ns) {
  const auto& head = *failed.front();
  const auto pause = head.is_flown        ? flown_pause_ns(head.tries, head.key, retry_after_ns)
                     : is_change(head.to) ? change_pause_ns(head.tries, head.key, retry_after_ns)
                                          : pause_ns(head.tries, head.key, retry_after_ns);
  if (is_change(head.to) || !has_expired(head.first_failure_ns, t.now_ns)) {
    for (auto* each : failed) {
      each->next_try_ns = t.now_ns + pause;
      t.tell(row_noted{*each, noted_as::waiting});
    }
    return;
  }
  const auto reason = "not delivered within 24 h of the first failure; the last one: " + head.last_error;
  const auto to = head.to;
  const auto mission_id = head.mission_id;
  if (is_map(to))
    note_of(t.s, mission_id).set_done(to, true);
  // Reports go in order: what is after this one could only be refused.
  give_up_all(t,
              keys_where(t.s,
                         [&](const outbox_row& each) {
                           return each.state == row_state::pending && each.to == to && each.mission_id == mission_id &&
                                  (to == destination::progress || has_expired(each.first_failure_ns, t.now_ns));
                         }),
              row_state::expired, reason);
}

// After a batch that went well larger ones are tried again.
void grow(state& s, const outbox_row& delivered) {
  auto& note = note_of(s, delivered.mission_id);
  const auto limit = note.limit(delivered.to);
  note.set_limit(delivered.to, limit >= largest_batch / 2 ? 0 : limit * 2);
}

} // namespace

bool is_repetition(const state& s, const std::string& key) {
  return find_row(s.rows, key) != nullptr || std::ranges::find(s.resolved_keys, key) != s.resolved_keys.end();
}

void remember(state& s, const std::string& key) {
  if (s.resolved_keys.size() >= max_resolved_keys)
    s.resolved_keys.erase(s.resolved_keys.begin());
  s.resolved_keys.push_back(key);
}

bool add_row(decision_context& t, outbox_row row, std::size_t reserve) {
  auto& s = t.s;
  if (s.rows.size() >= max_outbox_rows + reserve) {
    ++s.refused_rows;
    return false;
  }
  row.order = s.next_order++;
  row.created_ns = t.now_ns;
  row.next_try_ns = t.now_ns;
  s.rows.push_back(std::move(row));
  t.tell(row_noted{s.rows.back(), noted_as::waiting});
  return true;
}

void remove_row(decision_context& t, const std::string& key, noted_as how) { remove_rows(t, {key}, how); }

void give_up_all(decision_context& t, const std::vector<std::string>& keys, row_state as, const std::string& reason) {
  const std::unordered_set<std::string_view> given_up(keys.begin(), keys.end());
  std::vector<std::string> changes;
  for (auto& each : t.s.rows) {
    if (!given_up.contains(each.key))
      continue;
    each.last_error = cut_error(reason);
    if (is_change(each.to)) {
      t.tell(change_outcome{each.key, change_verdict::refused, reason});
      changes.push_back(each.key);
    } else {
      each.state = as;
      t.tell(row_noted{each, noted_as::waiting});
    }
  }
  if (!changes.empty())
    remove_rows(t, changes, noted_as::dropped);
}

void give_up(decision_context& t, const std::string& key, row_state as, const std::string& reason) {
  give_up_all(t, {key}, as, reason);
}

void take(decision_context& t, const respond_to_assignment& m) {
  auto& s = t.s;
  const auto& key = m.response.idempotency_key;
  auto response = m.response;
  if (response.last_progress && is_left_out(note_of(s, m.mission_id), *response.last_progress))
    response.last_progress.reset();
  if (response.last_progress) {
    response.last_progress = as_known(*response.last_progress, s.schema_version);
    response.last_progress->report_no = number_at_service(note_of(s, m.mission_id), response.last_progress->report_no);
  }
  if (is_repetition(s, key) || !add_row(t,
                                        {.key = key,
                                         .to = destination::assignment_response,
                                         .mission_id = m.mission_id,
                                         .subject = m.assignment_id,
                                         .body = mission::to_text(response)},
                                        outbox_reserve))
    return;
  for (auto& each : s.assignments) {
    if (each.what.assignment_id != m.assignment_id || s.mission_id != m.mission_id)
      continue;
    each.is_responded = true;
    if (m.response.outcome == mission::assignment_outcome::accepted)
      s.revision = std::max(s.revision, each.what.revision);
  }
  if (is_deleted(s, m.mission_id))
    give_up(t, key, row_state::orphaned, std::string(mission_is_deleted));
}

// Where the service takes none, or there is no room, there is nothing to deliver.
void take(decision_context& t, const deliver_picture& m) {
  const auto key = derived_key({"picture", m.mission_id, m.observation_id});
  t.tell(picture_noted{});
  if (!mission::takes_pictures(t.s.schema_version) || is_deleted(t.s, m.mission_id) || is_repetition(t.s, key))
    return;
  const mission::observation_picture body{key, m.observation_id, mission::utc_text(m.captured_ns), {}};
  (void)add_row(t,
                {.key = key,
                 .to = destination::picture,
                 .mission_id = m.mission_id,
                 .subject = m.file,
                 .body = mission::to_text(body)},
                0);
}

void take(decision_context& t, const batch_planned& m) {
  if (!is_repetition(t.s, m.key))
    (void)add_row(t, {.key = m.key, .to = m.to, .mission_id = m.mission_id}, outbox_reserve);
}

void take(decision_context& t, const batch_empty& m) {
  if (const auto* row = find_row(t.s.rows, m.key); row != nullptr) {
    note_of(t.s, row->mission_id).set_done(row->to, true);
    remove_row(t, m.key, noted_as::delivered);
  }
}

// Its rows are pending in the store again, and are taken under another key.
void take(decision_context& t, const batch_returned& m) { remove_row(t, m.key, noted_as::returned); }

void take(decision_context& t, const rows_delivered& m) {
  for (const auto& key : m.keys)
    if (const auto* row = find_row(t.s.rows, key); row != nullptr && is_map(row->to))
      grow(t.s, *row);
  remove_rows(t, m.keys, noted_as::delivered);
}

void take(decision_context& t, const rows_failed& m) {
  std::vector<outbox_row*> failed;
  for (const auto& key : m.keys) {
    auto* row = find_row(t.s.rows, key);
    if (row == nullptr || row->state != row_state::pending)
      continue;
    ++row->tries;
    row->last_error = cut_error(m.error);
    if (row->first_failure_ns == 0 || row->first_failure_ns > t.now_ns)
      row->first_failure_ns = t.now_ns;
    failed.push_back(row);
  }
  if (!failed.empty())
    expire_or_wait(t, failed, m.retry_after_ns);
}

void take(decision_context& t, const rows_refused& m) {
  auto* head = m.keys.empty() ? nullptr : find_row(t.s.rows, m.keys.front());
  if (head == nullptr)
    return;
  if (is_map(head->to) && !m.ends_lane && m.rows > 1) { // one row may be what is wrong: it is looked for in halves
    head->goes_back = true;
    ++head->tries;
    head->last_error = cut_error(m.reason);
    head->next_try_ns = t.now_ns;
    note_of(t.s, head->mission_id).set_limit(head->to, m.rows / 2);
    return t.tell(row_noted{*head, noted_as::waiting});
  }
  const auto to = head->to;
  const auto mission_id = head->mission_id;
  give_up_all(t, m.keys, row_state::orphaned, m.reason);
  if (!is_map(to))
    return;
  const auto refused = std::ranges::count_if(t.s.rows, [&](const outbox_row& each) {
    return each.state == row_state::orphaned && each.to == to && each.mission_id == mission_id;
  });
  if (!m.ends_lane && refused < max_refused_batches)
    return;
  note_of(t.s, mission_id).set_done(to, true);
  add_store_operation(t.s, store_operation_kind::orphan_mission, mission_id, m.reason);
}

void take(decision_context& t, const retry_outbox& m) {
  retry_answer answer;
  if (m.key.empty()) {
    add_store_operation(t.s, store_operation_kind::requeue_mission, {}, {});
    for (auto& note : t.s.missions)
      note.is_deleted = false; // whether it still is, the service will say
  }
  for (auto& each : t.s.rows) {
    if (!m.key.empty() && each.key != m.key)
      continue;
    each.next_try_ns = t.now_ns;
    // What a service has refused it refuses under that key for ever.
    each.goes_back = each.goes_back || (each.state == row_state::orphaned && is_map(each.to));
    if (std::exchange(each.state, row_state::pending) == row_state::pending) {
      ++answer.tried_now;
    } else {
      ++answer.queued;
      each.tries = 0;
      each.first_failure_ns = 0;
      auto& note = note_of(t.s, each.mission_id);
      note.is_deleted = false;
      if (is_map(each.to)) {
        note.is_pushing = true;
        note.set_done(each.to, false);
        add_store_operation(t.s, store_operation_kind::requeue_mission, each.mission_id, {});
      }
    }
    t.tell(row_noted{each, noted_as::waiting});
  }
  if (!m.key.empty() && answer.tried_now + answer.queued == 0)
    answer.error = "no row of the outbox has the key " + m.key;
  t.tell(answer);
}

void take(decision_context& t, const clock_jumped& m) {
  for (auto& each : t.s.rows) {
    each.next_try_ns += m.by_ns;
    if (each.first_failure_ns != 0)
      each.first_failure_ns += m.by_ns;
    if (is_change(each.to))
      each.created_ns += m.by_ns;
  }
}

} // namespace godwit::mission_client
