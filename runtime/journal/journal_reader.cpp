#include "runtime/journal/journal_reader.hpp"

#include "runtime/journal/sqlite_error.hpp"

namespace godwit::runtime {

namespace {

using io::sqlite::statement;

delivery_state state_of(const std::string& word) {
  if (word == "delivered")
    return delivery_state::delivered;
  if (word == "orphaned")
    return delivery_state::orphaned;
  return word == "expired" ? delivery_state::expired : delivery_state::pending;
}

} // namespace

template <class Row, class Take, class... Values>
journal_reader::result<std::vector<Row>> journal_reader::list(const std::string& sql, const Take& take,
                                                              const Values&... values) {
  auto query = db_.prepare(sql + " LIMIT " + std::to_string(max_rows));
  if (!query)
    return tl::unexpected(from_sqlite(query.error(), path_, "reading"));
  query->with(values...);
  std::vector<Row> rows;
  auto row = query->step();
  for (; row && *row; row = query->step())
    rows.push_back(take(*query));
  if (!row)
    return tl::unexpected(from_sqlite(row.error(), path_, "reading"));
  return rows;
}

journal_reader::result<journal_reader> journal_reader::open(const std::string& path, const std::string& vfs) {
  auto db = open_for_reading(path, vfs);
  if (!db)
    return tl::unexpected(std::move(db.error()));
  return journal_reader(std::move(*db), path);
}

journal_reader::result<std::vector<actor_summary>> journal_reader::actors() {
  return list<actor_summary>("SELECT name, last_event, events_after_snapshot, pending_effects FROM actor ORDER BY name",
                             [](const statement& row) {
                               return actor_summary{row.text(0), row.integer(1), row.integer(2), row.integer(3)};
                             });
}

journal_reader::result<std::vector<event_record>> journal_reader::events(const std::string& actor,
                                                                         std::int64_t after_number) {
  return list<event_record>(
      "SELECT number, at_ns, type, body FROM actor_event WHERE actor = ? AND number > ? ORDER BY number",
      [](const statement& row) {
        return event_record{row.integer(0), row.integer(1), row.text(2), row.text(3)};
      },
      actor, after_number);
}

journal_reader::result<std::optional<snapshot_record>> journal_reader::snapshot(const std::string& actor) {
  auto rows = list<snapshot_record>(
      "SELECT number, at_ns, version, body FROM actor_snapshot WHERE actor = ?",
      [](const statement& row) {
        return snapshot_record{row.integer(0), row.integer(1), static_cast<int>(row.integer(2)), row.text(3)};
      },
      actor);
  if (!rows)
    return tl::unexpected(std::move(rows.error()));
  return rows->empty() ? std::nullopt : std::optional(std::move(rows->front()));
}

journal_reader::result<std::vector<effect_record>> journal_reader::effects(const std::string& actor) {
  return list<effect_record>(
      "SELECT event, n, type, body, answer_to FROM effect WHERE actor = ? ORDER BY event, n",
      [](const statement& row) {
        return effect_record{{row.integer(0), static_cast<std::uint32_t>(row.integer(1))},
                             row.text(2),
                             row.text(3),
                             static_cast<std::uint64_t>(row.integer(4))};
      },
      actor);
}

journal_reader::result<std::vector<outbox_row>> journal_reader::outbox(const std::string& actor) {
  return list<outbox_row>(
      "SELECT idempotency_key, destination, body, created_ns, state, tries, last_error, next_try_ns, first_failure_ns "
      "FROM outbox WHERE actor = ? ORDER BY created_ns, idempotency_key",
      [](const statement& row) {
        return outbox_row{row.text(0),    row.text(1), row.text(2),    row.integer(3), state_of(row.text(4)),
                          row.integer(5), row.text(6), row.integer(7), row.integer(8)};
      },
      actor);
}

journal_reader::result<std::vector<dead_letter>> journal_reader::dead_letters(const std::string& actor) {
  return list<dead_letter>(
      "SELECT message_id, cause_id, at_ns, sender, type, body, attempts, reason FROM dead_letter WHERE actor = ? ORDER "
      "BY id",
      [](const statement& row) {
        return dead_letter{static_cast<std::uint64_t>(row.integer(0)),
                           static_cast<std::uint64_t>(row.integer(1)),
                           row.integer(2),
                           row.text(3),
                           row.text(4),
                           row.text(5),
                           static_cast<int>(row.integer(6)),
                           row.text(7)};
      },
      actor);
}

journal_reader::result<void> journal_reader::check(integrity_check check) { return check_integrity(db_, path_, check); }

} // namespace godwit::runtime
