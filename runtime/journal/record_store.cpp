#include "runtime/journal/record_store.hpp"

#include <algorithm>

#include <sqlite3.h>

#include "runtime/assert.hpp"

namespace godwit::runtime {

namespace {

using io::sqlite::result;
using io::sqlite::statement;

constexpr const char* insert_event = "INSERT INTO actor_event(actor, number, at_ns, type, body) VALUES (?, ?, ?, ?, ?)";
constexpr const char* upsert_snapshot =
    "INSERT INTO actor_snapshot(actor, number, at_ns, version, body) VALUES (?, ?, ?, ?, ?) ON CONFLICT(actor) DO "
    "UPDATE SET "
    "number = excluded.number, at_ns = excluded.at_ns, version = excluded.version, body = excluded.body "
    "WHERE excluded.number >= number";
constexpr const char* delete_covered = "DELETE FROM actor_event WHERE actor = ? AND number <= ?";
constexpr const char* insert_effect =
    "INSERT INTO effect(actor, event, n, type, body, answer_to) VALUES (?, ?, ?, ?, ?, ?)";
constexpr const char* delete_effect = "DELETE FROM effect WHERE actor = ? AND event = ? AND n = ?";
constexpr const char* upsert_mark =
    "INSERT INTO seen_mark(actor, source, event, n) VALUES (?, ?, ?, ?) ON CONFLICT(actor, source) DO UPDATE SET "
    "event = excluded.event, n = excluded.n WHERE (excluded.event, excluded.n) > (event, n)";
constexpr const char* upsert_outbox =
    "INSERT INTO outbox(idempotency_key, actor, destination, body, created_ns, state, tries, last_error, next_try_ns, "
    "first_failure_ns) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?) ON CONFLICT(idempotency_key) DO UPDATE SET "
    "actor = excluded.actor, destination = excluded.destination, body = excluded.body, created_ns = "
    "excluded.created_ns, "
    "state = excluded.state, tries = excluded.tries, last_error = excluded.last_error, next_try_ns = "
    "excluded.next_try_ns, "
    "first_failure_ns = excluded.first_failure_ns";
constexpr const char* insert_dead_letter =
    "INSERT INTO dead_letter(actor, at_ns, message_id, cause_id, sender, type, body, attempts, reason) "
    "VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)";
constexpr const char* drop_old_dead_letters =
    "DELETE FROM dead_letter WHERE actor = ?1 AND id <= (SELECT id FROM dead_letter WHERE actor = ?1 "
    "ORDER BY id DESC LIMIT 1 OFFSET ?2)";
constexpr const char* select_last = "SELECT max(coalesce((SELECT number FROM actor_snapshot WHERE actor = ?1), 0), "
                                    "coalesce((SELECT max(number) FROM actor_event WHERE actor = ?1), 0))";
constexpr const char* select_snapshot = "SELECT number, at_ns, version, body FROM actor_snapshot WHERE actor = ?";
constexpr const char* select_events =
    "SELECT number, at_ns, type, body FROM actor_event WHERE actor = ? AND number > ? ORDER BY number";
constexpr const char* select_effects =
    "SELECT event, n, type, body, answer_to FROM effect WHERE actor = ? ORDER BY event, n";
constexpr const char* select_marks = "SELECT source, event, n FROM seen_mark WHERE actor = ? ORDER BY source";

io::sqlite::error misuse(const std::string& why, const std::string& sql) {
  return {.code = SQLITE_MISUSE, .extended = SQLITE_MISUSE, .system_errno = 0, .message = why + " in \"" + sql + "\""};
}

} // namespace

const char* to_string(delivery_state state) {
  switch (state) {
  case delivery_state::pending:
    return "pending";
  case delivery_state::delivered:
    return "delivered";
  case delivery_state::orphaned:
    return "orphaned";
  case delivery_state::expired:
    return "expired";
  }
  return "unknown";
}

template <class... Values>
result<void> record_store::run(std::string_view sql, const Values&... values) {
  return statements_.get(sql).and_then([&](statement* prepared) { return prepared->with(values...).run(); });
}

template <class Take, class... Values>
result<void> record_store::each(std::string_view sql, const Take& take, const Values&... values) {
  auto prepared = statements_.get(sql);
  if (!prepared)
    return tl::unexpected(std::move(prepared.error()));
  auto& query = (*prepared)->with(values...);
  auto row = query.step();
  for (; row && *row; row = query.step())
    take(query);
  query.reset();
  if (!row)
    return tl::unexpected(std::move(row.error()));
  return {};
}

result<void> record_store::apply(const journal_write& write) {
  for (const auto& event : write.events)
    if (auto done = add_event(write.actor, event); !done)
      return done;
  if (write.snapshot)
    if (auto done = replace_snapshot(write.actor, *write.snapshot); !done)
      return done;
  for (const auto part : {&record_store::add_effects, &record_store::add_marks, &record_store::add_outbox,
                          &record_store::add_dead_letters})
    if (auto done = (this->*part)(write); !done)
      return done;
  for (const auto& change : write.rows)
    if (auto done = apply(change); !done)
      return done;
  return {};
}

result<void> record_store::apply(const row_change& change) {
  auto prepared = statements_.get(change.sql);
  if (!prepared)
    return tl::unexpected(std::move(prepared.error()));
  auto& to_run = **prepared;
  if (!to_run.changes_data()) // a COMMIT here would cut the group's transaction in two
    return tl::unexpected(misuse("this does not change a row", change.sql));
  if (static_cast<std::size_t>(to_run.parameter_count()) != change.values.size())
    return tl::unexpected(misuse(std::to_string(change.values.size()) + " values for " +
                                     std::to_string(to_run.parameter_count()) + " parameters",
                                 change.sql));
  int parameter = 0;
  for (const auto& value : change.values)
    std::visit([&](const auto& content) { to_run.bind(++parameter, content); }, value);
  return to_run.run();
}

void record_store::keep_numbers() {
  for (auto& [actor, number] : staged_)
    committed_[actor] = number;
  staged_.clear();
}

result<std::int64_t> record_store::last_number(const std::string& actor) {
  if (const auto found = staged_.find(actor); found != staged_.end())
    return found->second;
  if (const auto found = committed_.find(actor); found != committed_.end())
    return found->second;
  std::int64_t number = 0;
  return each(
             select_last, [&](const statement& row) { number = row.integer(0); }, actor)
      .map([&] { return number; });
}

result<void> record_store::add_event(const std::string& actor, const event_record& event) {
  const auto last = last_number(actor);
  if (!last)
    return tl::unexpected(last.error());
  GODWIT_ASSERT(event.number == *last + 1, "journal: event " + std::to_string(event.number) + " of actor " + actor +
                                               " follows event " + std::to_string(*last));
  staged_[actor] = event.number;
  return run(insert_event, actor, event.number, event.at_ns, event.type, event.body);
}

result<void> record_store::replace_snapshot(const std::string& actor, const snapshot_record& snapshot) {
  const auto last = last_number(actor);
  if (!last)
    return tl::unexpected(last.error());
  staged_[actor] = std::max(*last, snapshot.number);
  auto done = run(upsert_snapshot, actor, snapshot.number, snapshot.at_ns, snapshot.version, snapshot.body);
  if (!done)
    return done;
  GODWIT_ASSERT(db_->changes() == 1, "journal: snapshot " + std::to_string(snapshot.number) + " of actor " + actor +
                                         " is older than the one it replaces");
  return run(delete_covered, actor, snapshot.number);
}

result<void> record_store::add_effects(const journal_write& write) {
  for (const auto& effect : write.effects) {
    auto done =
        run(insert_effect, write.actor, effect.id.event, effect.id.n, effect.type, effect.body, effect.answer_to);
    if (!done)
      return done;
  }
  for (const auto& id : write.released)
    if (auto done = run(delete_effect, write.actor, id.event, id.n); !done)
      return done;
  return {};
}

result<void> record_store::add_marks(const journal_write& write) {
  for (const auto& mark : write.seen)
    if (auto done = run(upsert_mark, write.actor, mark.source, mark.upto.event, mark.upto.n); !done)
      return done;
  return {};
}

result<void> record_store::add_outbox(const journal_write& write) {
  for (const auto& row : write.outbox) {
    auto done = run(upsert_outbox, row.idempotency_key, write.actor, row.destination, row.body, row.created_ns,
                    to_string(row.state), row.tries, row.last_error, row.next_try_ns, row.first_failure_ns);
    if (!done)
      return done;
  }
  return {};
}

result<void> record_store::add_dead_letters(const journal_write& write) {
  for (const auto& letter : write.dead_letters) {
    auto done = run(insert_dead_letter, write.actor, letter.at_ns, letter.message_id, letter.cause_id, letter.sender,
                    letter.type, letter.body, letter.attempts, letter.reason);
    if (!done)
      return done;
  }
  return write.dead_letters.empty() ? result<void>{} : run(drop_old_dead_letters, write.actor, max_dead_letters);
}

result<recovered> record_store::read(const std::string& actor) {
  recovered state;
  const auto take_snapshot = [&](const statement& row) {
    state.snapshot = {row.integer(0), row.integer(1), static_cast<int>(row.integer(2)), row.text(3)};
    state.last_event = row.integer(0);
  };
  bool whole = true;
  const auto take_event = [&](const statement& row) {
    state.events.push_back({row.integer(0), row.integer(1), row.text(2), row.text(3)});
    whole = whole && state.events.back().number == state.last_event + 1;
    state.last_event = state.events.back().number;
  };
  const auto take_effect = [&](const statement& row) {
    state.effects.push_back({{row.integer(0), static_cast<std::uint32_t>(row.integer(1))},
                             row.text(2),
                             row.text(3),
                             static_cast<std::uint64_t>(row.integer(4))});
  };
  const auto take_mark = [&](const statement& row) {
    state.seen.push_back({row.text(0), {row.integer(1), static_cast<std::uint32_t>(row.integer(2))}});
  };
  const auto done = each(select_snapshot, take_snapshot, actor)
                        .and_then([&] { return each(select_events, take_event, actor, state.last_event); })
                        .and_then([&] { return each(select_effects, take_effect, actor); })
                        .and_then([&] { return each(select_marks, take_mark, actor); });
  if (!done)
    return tl::unexpected(done.error());
  if (!whole) // apply never writes a gap, so somebody else has changed the rows
    return tl::unexpected(io::sqlite::error{.code = SQLITE_CORRUPT,
                                            .extended = SQLITE_CORRUPT,
                                            .system_errno = 0,
                                            .message = "the events of actor " + actor + " have a gap"});
  state.durable_upto = state.last_event;
  return state;
}

} // namespace godwit::runtime
