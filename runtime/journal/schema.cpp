#include "runtime/journal/schema.hpp"

#include "io/sqlite/transaction.hpp"
#include "runtime/journal/sqlite_error.hpp"

namespace godwit::runtime {

namespace {

using io::sqlite::database;

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

const std::vector<std::string>& own_migrations() {
  static const std::vector<std::string> migrations{first_version};
  return migrations;
}

std::int64_t newest(const table_definition& table) { return static_cast<std::int64_t>(table.migrations.size()); }

journal_error newer_error(const std::string& file, const std::string& name, std::int64_t found, std::int64_t known) {
  return {journal_errc::newer, file,
          name + " has version " + std::to_string(found) + ", this program knows up to " + std::to_string(known),
          "Start the newer godwit that wrote it, or move the journal away."};
}

std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text)
    result.append(c == '\'' ? 2 : 1, c);
  return result + "'";
}

io::sqlite::result<std::int64_t> version_of(database& db, const std::string& name) {
  return db.query_integer("SELECT version FROM table_version WHERE name = " + quoted(name));
}

// Runs the steps above FOUND and SET_VERSION in one transaction.
io::sqlite::result<void> run_steps(database& db, const std::vector<std::string>& steps, std::int64_t found,
                                   const std::string& set_version) {
  auto change = io::sqlite::transaction::begin(db);
  if (!change)
    return tl::unexpected(std::move(change.error()));
  for (auto i = static_cast<std::size_t>(found); i < steps.size(); ++i)
    if (auto done = db.exec(steps[i]); !done)
      return done;
  if (auto done = db.exec(set_version); !done)
    return done;
  return change->commit();
}

} // namespace

std::int64_t journal_schema_version() { return static_cast<std::int64_t>(own_migrations().size()); }

tl::expected<void, journal_error> check_identity(database& db, const std::string& file) {
  const auto application = db.query_integer("PRAGMA application_id");
  if (!application)
    return tl::unexpected(from_sqlite(application.error(), file, "reading its header"));
  if (*application != journal_application_id)
    return tl::unexpected(foreign_file(file, "an SQLite database of another program"));
  const auto version = db.query_integer("PRAGMA user_version");
  if (!version)
    return tl::unexpected(from_sqlite(version.error(), file, "reading its version"));
  if (*version > journal_schema_version())
    return tl::unexpected(newer_error(file, "the journal", *version, journal_schema_version()));
  if (*version < 1)
    return tl::unexpected(corrupt_file(file, "its version is " + std::to_string(*version)));
  return {};
}

tl::expected<void, journal_error> check_tables(database& db, const std::string& file,
                                               const std::vector<table_definition>& tables) {
  for (const auto& table : tables) {
    const auto found = version_of(db, table.name);
    if (!found)
      return tl::unexpected(from_sqlite(found.error(), file, "reading the version of table " + table.name));
    if (*found > newest(table))
      return tl::unexpected(newer_error(file, "table " + table.name, *found, newest(table)));
  }
  return {};
}

tl::expected<void, journal_error> migrate(database& db, const std::string& file,
                                          const std::vector<table_definition>& tables) {
  const auto own = db.query_integer("PRAGMA user_version");
  if (!own)
    return tl::unexpected(from_sqlite(own.error(), file, "reading its version"));
  if (*own < journal_schema_version()) {
    const auto version = std::to_string(journal_schema_version());
    if (auto done = run_steps(db, own_migrations(), *own, "PRAGMA user_version = " + version); !done)
      return tl::unexpected(from_sqlite(done.error(), file, "moving the journal to version " + version));
  }
  for (const auto& table : tables) {
    const auto found = version_of(db, table.name);
    if (!found)
      return tl::unexpected(from_sqlite(found.error(), file, "reading the version of table " + table.name));
    if (*found == newest(table))
      continue;
    const auto set = "INSERT INTO table_version VALUES (" + quoted(table.name) + ", " + std::to_string(newest(table)) +
                     ") ON CONFLICT(name) DO UPDATE SET version = excluded.version";
    if (auto done = run_steps(db, table.migrations, *found, set); !done)
      return tl::unexpected(from_sqlite(done.error(), file, "moving table " + table.name + " to its newest version"));
  }
  return {};
}

} // namespace godwit::runtime
