// Changes that the vehicle asks of the service, or flies already.
#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "actors/domain/mission/read.hpp"
#include "actors/domain/mission/write.hpp"
#include "actors/mission_client/decision_context.hpp"
#include "runtime/assert.hpp"

namespace godwit::mission_client {

namespace {

struct change_content {
  std::int32_t base_revision = 0;
  std::vector<mission::item> items;
};

change_content content_of(const outbox_row& change) {
  if (change.to == destination::waypoint) {
    auto insert = mission::read<mission::waypoint_insert>(change.body);
    GODWIT_ASSERT(insert.has_value(), "an insert in the outbox is one");
    return {insert->base_revision, {std::move(insert->waypoint)}};
  }
  auto tail = mission::read<mission::tail>(change.body);
  GODWIT_ASSERT(tail.has_value(), "a tail in the outbox is one");
  return {tail->base_revision, std::move(tail->items)};
}

// The service has numbered the change as the vehicle has, and has what the vehicle flies.
bool is_as_flown(const mission::document& document, destination to, const change_content& content) {
  if (document.revision != content.base_revision + 1)
    return false;
  if (to == destination::waypoint)
    return std::ranges::find(document.items, content.items.front()) != document.items.end();
  return document.items.size() >= content.items.size() &&
         std::equal(content.items.rbegin(), content.items.rend(), document.items.rbegin());
}

// The service has answered, so that it is there: what waits for it goes out now.
void make_due(decision_context& t, const std::string& mission_id) {
  for (auto& each : t.s.rows)
    if (each.mission_id == mission_id && each.state == row_state::pending)
      each.next_try_ns = std::min(each.next_try_ns, t.now_ns);
}

void turn_down(decision_context& t, const outbox_row& change, const std::string& reason) {
  remember(t.s, change.is_flown ? flown_key(change.key) : change.key);
  if (change.is_flown)
    leave_items_out(t, change.mission_id, content_of(change).items, t.s.next_order);
  t.tell(change_outcome{change.key, change_verdict::refused, reason});
}

// Known as one that is waited for, and not yet as one that is flown: the row stays where it is.
bool becomes_flown(decision_context& t, const outbox_row& change) {
  auto* known = find_row(t.s.rows, change.key);
  if (known == nullptr || known->is_flown || !change.is_flown)
    return false;
  known->is_flown = true;
  known->tries = 0;
  known->next_try_ns = t.now_ns;
  t.tell(row_noted{*known, noted_as::waiting});
  return true;
}

void take_change(decision_context& t, outbox_row change) {
  if (becomes_flown(t, change) || find_row(t.s.rows, change.key) != nullptr ||
      is_repetition(t.s, flown_key(change.key)) || (!change.is_flown && is_repetition(t.s, change.key)))
    return;
  if (is_deleted(t.s, change.mission_id))
    turn_down(t, change, std::string(mission_is_deleted));
  else if (!add_row(t, change, outbox_reserve))
    turn_down(t, change, "too much waits for the missions service");
}

// What was built on a change that the service does not have: it would be made to something else there.
std::vector<std::string> built_on(const state& s, const outbox_row& change) {
  return keys_where(s, [&](const outbox_row& each) {
    return is_change(each.to) && each.mission_id == change.mission_id && each.order > change.order;
  });
}

void fail_change(decision_context& t, const std::string& key, change_verdict verdict, const std::string& reason) {
  auto* row = find_row(t.s.rows, key);
  row->last_error = cut_error(reason);
  const auto order = row->order;
  const auto mission_id = row->mission_id;
  const auto flown = row->is_flown ? std::optional(content_of(*row)) : std::nullopt;
  if ((verdict != change_verdict::refused || flown) && mission_id == t.s.mission_id)
    t.s.looks_up = true;
  if (flown && mission_id == t.s.mission_id) // any newer one of the service counts, whatever we have numbered since
    t.s.revision = std::min(t.s.revision, flown->base_revision);
  remove_row(t, key, noted_as::dropped);
  if (flown)
    leave_items_out(t, mission_id, flown->items, order);
  t.tell(change_outcome{key, verdict, reason});
}

} // namespace

std::string flown_key(const std::string& key) { return key + " flown"; }

void take(decision_context& t, const insert_waypoint& m) {
  take_change(t, {.key = m.insert.idempotency_key,
                  .to = destination::waypoint,
                  .mission_id = m.mission_id,
                  .body = mission::to_text(m.insert),
                  .is_flown = m.is_flown});
}

void take(decision_context& t, const replace_tail& m) {
  take_change(t, {.key = m.tail.idempotency_key,
                  .to = destination::tail,
                  .mission_id = m.mission_id,
                  .body = mission::to_text(m.tail),
                  .is_flown = m.is_flown});
}

// As the vehicle flies it: nothing has to come of it there. Else the service's revision is flown as any of its own.
void take(decision_context& t, const change_done& m) {
  auto& s = t.s;
  const auto* row = find_row(s.rows, m.key);
  if (row == nullptr)
    return;
  const auto flown = row->is_flown ? std::optional(content_of(*row)) : std::nullopt;
  const bool is_other = flown && !is_as_flown(m.document, row->to, *flown);
  const std::string reason = "the service has made another revision of it, which is flown instead";
  if (is_other) {
    for (const auto& each : built_on(s, *row))
      fail_change(t, each, change_verdict::stale, reason);
    s.revision = std::min(s.revision, flown->base_revision);
    t.tell(change_outcome{m.key, change_verdict::stale, reason});
  }
  remove_row(t, m.key, noted_as::delivered);
  note_known_items(t, m.document);
  make_due(t, m.document.mission_id);
  if (s.mission_id == m.document.mission_id && m.document.revision > s.revision) {
    s.revision = m.document.revision;
    s.schema_version = m.document.schema_version;
    if (is_other || !flown)
      t.tell(mission_loaded{load_cause::changed, m.document});
  }
  if (!is_other)
    t.tell(change_outcome{m.key, change_verdict::done, {}});
}

void take(decision_context& t, const change_failed& m) {
  const auto* row = find_row(t.s.rows, m.key);
  if (row == nullptr)
    return;
  const auto mission_id = row->mission_id;
  if (row->is_flown)
    for (const auto& each : built_on(t.s, *row))
      fail_change(t, each, change_verdict::stale, "it was made to a change that the service does not have");
  fail_change(t, m.key, m.verdict, m.reason);
  make_due(t, mission_id);
}

} // namespace godwit::mission_client
