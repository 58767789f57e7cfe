#include "actors/mapobjects_store/schema.hpp"

#include <array>

#include "actors/mapobjects_store/sqlite_error.hpp"
#include "io/sqlite/transaction.hpp"

namespace godwit::mapobjects_store {

namespace {

// Only one of the two trees of loaded places is shown; the next load fills the other one, which is empty: filling it is
// not slowed down by what is on the map. AUTOINCREMENT: numbers never come again, also not after the highest row is
// gone.
constexpr const char* first_version = R"(
CREATE TABLE schema_version(version INTEGER NOT NULL);
INSERT INTO schema_version VALUES (0);
CREATE TABLE map(
  one INTEGER PRIMARY KEY CHECK(one = 1),
  mission_id TEXT NOT NULL, sync_state TEXT NOT NULL
    CHECK(sync_state IN ('fresh_boot', 'synced', 'cached_fallback', 'degraded', 'failed')),
  pulled_mission_id TEXT NOT NULL, pulled_ns INTEGER NOT NULL, generation INTEGER NOT NULL,
  first_object INTEGER NOT NULL, last_object INTEGER NOT NULL, ignored_items INTEGER NOT NULL,
  tree INTEGER NOT NULL CHECK(tree IN (0, 1)),
  pulled_observation INTEGER NOT NULL, pulled_ignored_item INTEGER NOT NULL, last_generation INTEGER NOT NULL);
INSERT INTO map VALUES (1, '', 'fresh_boot', '', 0, 0, 1, 0, 0, 0, 0, 0, 0);
CREATE TABLE loaded_object(
  number INTEGER PRIMARY KEY, id TEXT NOT NULL, class_group TEXT NOT NULL,
  latitude_deg REAL NOT NULL, longitude_deg REAL NOT NULL, altitude_m REAL,
  first_seen_ns INTEGER NOT NULL, last_seen_ns INTEGER NOT NULL, confidence REAL NOT NULL);
CREATE VIRTUAL TABLE loaded_place_0 USING rtree(
  number, min_latitude_deg, max_latitude_deg, min_longitude_deg, max_longitude_deg);
CREATE VIRTUAL TABLE loaded_place_1 USING rtree(
  number, min_latitude_deg, max_latitude_deg, min_longitude_deg, max_longitude_deg);
CREATE TABLE seen_object(
  number INTEGER PRIMARY KEY, id TEXT NOT NULL UNIQUE, mission_id TEXT NOT NULL, class_group TEXT NOT NULL,
  latitude_deg REAL NOT NULL, longitude_deg REAL NOT NULL, altitude_m REAL,
  first_seen_ns INTEGER NOT NULL, last_seen_ns INTEGER NOT NULL, confidence REAL NOT NULL);
CREATE VIRTUAL TABLE seen_place USING rtree(
  number, min_latitude_deg, max_latitude_deg, min_longitude_deg, max_longitude_deg);
CREATE TABLE batch(
  number INTEGER PRIMARY KEY AUTOINCREMENT, key TEXT NOT NULL UNIQUE, mission_id TEXT NOT NULL,
  destination TEXT NOT NULL CHECK(destination IN ('observations', 'ignored_items')), rows INTEGER NOT NULL,
  state TEXT NOT NULL CHECK(state IN ('taken', 'orphaned', 'delivered')));
CREATE TABLE ignored_item(
  number INTEGER PRIMARY KEY AUTOINCREMENT, id TEXT NOT NULL, generation INTEGER NOT NULL, mission_id TEXT NOT NULL,
  mgrs_cell TEXT NOT NULL, class_group TEXT NOT NULL, since_ns INTEGER NOT NULL,
  delivery TEXT NOT NULL CHECK(delivery IN ('pending', 'taken', 'delivered', 'orphaned')), batch INTEGER,
  UNIQUE(generation, id));
CREATE INDEX ignored_item_place ON ignored_item(mgrs_cell, class_group);
CREATE INDEX ignored_item_pending ON ignored_item(mission_id, number) WHERE delivery = 'pending';
CREATE INDEX ignored_item_batch ON ignored_item(batch) WHERE batch IS NOT NULL;
CREATE TABLE observation(
  number INTEGER PRIMARY KEY AUTOINCREMENT, id TEXT NOT NULL UNIQUE, mission_id TEXT NOT NULL, object_id TEXT,
  kind TEXT NOT NULL CHECK(kind IN ('new', 'moved', 'existing', 'ignored', 'removed_candidate')),
  class_group TEXT NOT NULL, latitude_deg REAL NOT NULL, longitude_deg REAL NOT NULL, altitude_m REAL,
  at_ns INTEGER NOT NULL, confidence REAL NOT NULL,
  delivery TEXT NOT NULL CHECK(delivery IN ('pending', 'taken', 'delivered')), batch INTEGER);
CREATE INDEX observation_of_object ON observation(object_id, at_ns);
CREATE INDEX observation_pending ON observation(mission_id, number) WHERE delivery = 'pending';
CREATE INDEX observation_batch ON observation(batch) WHERE batch IS NOT NULL;
CREATE TABLE orphaned_observation(
  number INTEGER PRIMARY KEY, id TEXT NOT NULL UNIQUE, mission_id TEXT NOT NULL, object_id TEXT, kind TEXT NOT NULL,
  class_group TEXT NOT NULL, latitude_deg REAL NOT NULL, longitude_deg REAL NOT NULL, altitude_m REAL,
  at_ns INTEGER NOT NULL, confidence REAL NOT NULL, batch INTEGER, orphaned_ns INTEGER NOT NULL, reason TEXT NOT NULL);
CREATE INDEX orphaned_observation_batch ON orphaned_observation(batch);
CREATE INDEX orphaned_observation_of_object ON orphaned_observation(object_id, at_ns);
CREATE TABLE orphaned_ignored_item(
  number INTEGER PRIMARY KEY, id TEXT NOT NULL UNIQUE, mission_id TEXT NOT NULL, mgrs_cell TEXT NOT NULL,
  class_group TEXT NOT NULL, since_ns INTEGER NOT NULL, batch INTEGER, orphaned_ns INTEGER NOT NULL,
  reason TEXT NOT NULL);
CREATE INDEX orphaned_ignored_item_batch ON orphaned_ignored_item(batch);
)";

constexpr std::array migrations{first_version};

map_result<std::int64_t> version_of(io::sqlite::database& db) {
  const auto tables = db.query_integer("SELECT count(*) FROM sqlite_schema WHERE name = 'schema_version'");
  if (!tables)
    return tl::unexpected(from_sqlite(tables.error(), "looking for its tables"));
  if (*tables == 0)
    return 0;
  const auto version = db.query_integer("SELECT version FROM schema_version");
  if (!version)
    return tl::unexpected(from_sqlite(version.error(), "reading its version"));
  return *version;
}

io::sqlite::result<void> run_migrations(io::sqlite::database& db, std::int64_t found) {
  auto change = io::sqlite::transaction::begin(db);
  if (!change)
    return tl::unexpected(std::move(change.error()));
  for (auto i = static_cast<std::size_t>(found); i < migrations.size(); ++i)
    if (auto done = db.exec(migrations[i]); !done)
      return done;
  if (auto done = db.exec("UPDATE schema_version SET version = " + std::to_string(migrations.size())); !done)
    return done;
  return change->commit();
}

} // namespace

std::int64_t newest_schema_version() { return static_cast<std::int64_t>(migrations.size()); }

map_result<void> check_schema(io::sqlite::database& db, const std::string& file) {
  const auto application = db.query_integer("PRAGMA application_id");
  if (!application)
    return tl::unexpected(from_sqlite(application.error(), "reading the header of " + file));
  if (*application != map_application_id)
    return tl::unexpected(map_error{map_errc::foreign, file + " is an SQLite database of another program",
                                    "Name another file for the map, or move this one away if nobody needs it"});
  const auto version = version_of(db);
  if (!version)
    return tl::unexpected(version.error());
  if (*version > newest_schema_version())
    return tl::unexpected(map_error{map_errc::newer,
                                    file + " has version " + std::to_string(*version) + ", this program knows up to " +
                                        std::to_string(newest_schema_version()),
                                    "Start the newer godwit that wrote it, or move the map away"});
  return {};
}

map_result<void> migrate_schema(io::sqlite::database& db) {
  const auto found = version_of(db);
  if (!found)
    return tl::unexpected(found.error());
  if (*found == newest_schema_version())
    return {};
  if (auto done = run_migrations(db, *found); !done)
    return tl::unexpected(from_sqlite(done.error(), "bringing its tables to the newest version"));
  return {};
}

} // namespace godwit::mapobjects_store
