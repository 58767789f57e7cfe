#include "runtime/journal/journal_file.hpp"

#include <filesystem>

#include "io/sqlite/store_file.hpp"
#include "runtime/journal/sqlite_error.hpp"

namespace godwit::runtime {

namespace {

using io::sqlite::database;
using io::sqlite::store_result;

// Counts this run; it proves too that the file can be written before anybody relies on it.
store_result<void> count_run(database& db, const std::string& path) {
  if (auto done = db.exec("UPDATE meta SET value = value + 1 WHERE name = 'run'"); !done)
    return tl::unexpected(io::sqlite::describe(done.error(), journal_format().kind, path, "counting this run"));
  return {};
}

} // namespace

std::string journal_in_use(const std::string& path) {
  constexpr int most_rescues = 4;
  auto result = path;
  std::error_code ignored;
  for (int i = 0; i < most_rescues && std::filesystem::exists(result + rescued_suffix, ignored); ++i)
    result += rescued_suffix;
  return result;
}

tl::expected<io::sqlite::store_file, journal_error> open_for_writing(const file_options& options) {
  auto opened = io::sqlite::open_for_writing(
      journal_format(), {.path = options.path,
                         .vfs = options.vfs,
                         .create = options.create,
                         .check = options.check,
                         .inspect = [&](database& db) { return check_tables(db, options.path, options.tables); }});
  if (!opened)
    return tl::unexpected(from_store(opened.error()));
  const auto ready = migrate_tables(opened->db, options.path, options.tables).and_then([&] {
    return count_run(opened->db, options.path);
  });
  if (!ready)
    return tl::unexpected(from_store(ready.error()));
  return std::move(*opened);
}

tl::expected<database, journal_error> open_for_reading(const std::string& path, const std::string& vfs) {
  return io::sqlite::open_for_reading(journal_format(), path, vfs).map_error(from_store);
}

tl::expected<void, journal_error> check_integrity(database& db, const std::string& file, integrity_check check) {
  return io::sqlite::check_integrity(db, journal_format().kind, file, check).map_error(from_store);
}

namespace {

using io::sqlite::quoted;

// The last event number of an actor is not stored: a snapshot covers the events that it deletes, so the greater of the
// snapshot's number and the newest event is the highest number ever used. The view `actor` shows it.
constexpr const char* first_version = R"(
CREATE TABLE meta(name TEXT PRIMARY KEY, value) WITHOUT ROWID;
INSERT INTO meta VALUES ('run', 0);
CREATE TABLE table_version(name TEXT PRIMARY KEY, version INTEGER NOT NULL) WITHOUT ROWID;
CREATE TABLE actor_event(
  actor TEXT NOT NULL, number INTEGER NOT NULL, at_ns INTEGER NOT NULL, type TEXT NOT NULL, body TEXT NOT NULL,
  PRIMARY KEY(actor, number)) WITHOUT ROWID;
CREATE TABLE actor_snapshot(
  actor TEXT PRIMARY KEY, number INTEGER NOT NULL, at_ns INTEGER NOT NULL, version INTEGER NOT NULL, body TEXT NOT NULL);
CREATE TABLE effect(
  actor TEXT NOT NULL, event INTEGER NOT NULL, n INTEGER NOT NULL, type TEXT NOT NULL, body TEXT NOT NULL,
  answer_to INTEGER NOT NULL, PRIMARY KEY(actor, event, n)) WITHOUT ROWID;
CREATE TABLE seen_mark(
  actor TEXT NOT NULL, source TEXT NOT NULL, event INTEGER NOT NULL, n INTEGER NOT NULL,
  PRIMARY KEY(actor, source)) WITHOUT ROWID;
CREATE TABLE dead_letter(
  id INTEGER PRIMARY KEY, actor TEXT NOT NULL, at_ns INTEGER NOT NULL, message_id INTEGER NOT NULL,
  cause_id INTEGER NOT NULL, sender TEXT NOT NULL, type TEXT NOT NULL, body TEXT NOT NULL, attempts INTEGER NOT NULL,
  reason TEXT NOT NULL);
CREATE INDEX dead_letter_actor ON dead_letter(actor);
CREATE TABLE outbox(
  idempotency_key TEXT PRIMARY KEY, actor TEXT NOT NULL, destination TEXT NOT NULL, body TEXT NOT NULL,
  created_ns INTEGER NOT NULL, state TEXT NOT NULL CHECK(state IN ('pending', 'delivered', 'orphaned', 'expired')),
  tries INTEGER NOT NULL, last_error TEXT NOT NULL, next_try_ns INTEGER NOT NULL, first_failure_ns INTEGER NOT NULL)
  WITHOUT ROWID;
CREATE INDEX outbox_actor ON outbox(actor, created_ns);
CREATE VIEW actor AS
  SELECT name,
    max(coalesce((SELECT number FROM actor_snapshot WHERE actor = name), 0),
        coalesce((SELECT max(number) FROM actor_event WHERE actor = name), 0)) AS last_event,
    (SELECT count(*) FROM actor_event WHERE actor = name) AS events_after_snapshot,
    (SELECT count(*) FROM effect WHERE actor = name) AS pending_effects
  FROM (SELECT actor AS name FROM actor_event UNION SELECT actor FROM actor_snapshot UNION SELECT actor FROM effect);
)";

std::int64_t newest(const table_definition& table) { return static_cast<std::int64_t>(table.migrations.size()); }

// 0 = the table is not there.
store_result<std::int64_t> version_of(database& db, const std::string& file, const std::string& name) {
  auto found = db.query_integer("SELECT version FROM table_version WHERE name = " + quoted(name));
  if (!found)
    return tl::unexpected(
        io::sqlite::describe(found.error(), journal_format().kind, file, "reading the version of table " + name));
  return *found;
}

} // namespace

const io::sqlite::store_format& journal_format() {
  static const io::sqlite::store_format format{
      .kind = {.name = "journal",
               .when_corrupt = "Move it away together with its -wal file (the sqlite3 shell's .recover may save its "
                               "rows), then put back a copy or start without it"},
      .application_id = journal_application_id,
      .migrations = {first_version},
      .read_version = "PRAGMA user_version",
      .set_version = "PRAGMA user_version = ",
      .settings = "PRAGMA foreign_keys = ON"};
  return format;
}

store_result<void> check_tables(database& db, const std::string& file, const std::vector<table_definition>& tables) {
  for (const auto& table : tables) {
    const auto found = version_of(db, file, table.name);
    if (!found)
      return tl::unexpected(found.error());
    if (*found > newest(table))
      return tl::unexpected(
          io::sqlite::newer_file(journal_format().kind, file, "table " + table.name, *found, newest(table)));
  }
  return {};
}

store_result<void> migrate_tables(database& db, const std::string& file, const std::vector<table_definition>& tables) {
  for (const auto& table : tables) {
    const auto found = version_of(db, file, table.name);
    if (!found)
      return tl::unexpected(found.error());
    if (*found == newest(table))
      continue;
    const auto set = "INSERT INTO table_version VALUES (" + quoted(table.name) + ", " + std::to_string(newest(table)) +
                     ") ON CONFLICT(name) DO UPDATE SET version = excluded.version";
    if (auto done = io::sqlite::run_migrations(db, table.migrations, *found, set); !done)
      return tl::unexpected(io::sqlite::describe(done.error(), journal_format().kind, file,
                                                 "moving table " + table.name + " to its newest version"));
  }
  return {};
}

} // namespace godwit::runtime
