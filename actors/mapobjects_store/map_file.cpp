#include "actors/mapobjects_store/map_file.hpp"

#include "actors/mapobjects_store/error.hpp"

namespace godwit::mapobjects_store {

map_result<io::sqlite::store_file> open_map_for_writing(const map_file_options& options) {
  using io::sqlite::integrity_check;
  const io::sqlite::store_options wanted{.path = options.path,
                                         .vfs = options.vfs,
                                         .create = options.create,
                                         .check = options.check_pages ? integrity_check::quick : integrity_check::none,
                                         .inspect = {}};
  return io::sqlite::open_for_writing(map_format(), wanted).map_error(from_store);
}

map_result<io::sqlite::database> open_map_for_reading(const std::string& path, const std::string& vfs) {
  return io::sqlite::open_for_reading(map_format(), path, vfs).map_error(from_store);
}

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

// Of what was pulled, as the service names it: later only what has changed since is asked for.
constexpr const char* with_mark = "ALTER TABLE map ADD COLUMN pulled_mark TEXT NOT NULL DEFAULT ''";

} // namespace

// The cache holds the inner pages of a million objects and some leaves. Deleted rows need not be overwritten: nothing
// on the map is secret, and it would write each page of garbage.
const io::sqlite::store_format& map_format() {
  static const io::sqlite::store_format format{
      .kind = {.name = "map",
               .when_corrupt = "Move it away together with its -wal file (the sqlite3 shell's .recover may save what "
                               "was not delivered); the map itself is pulled again"},
      .application_id = map_application_id,
      .migrations = {first_version, with_mark},
      // Of the two the higher one: a later version may keep it where other files of godwit have it.
      .read_version = "SELECT max(version, (SELECT user_version FROM pragma_user_version)) FROM schema_version",
      .set_version = "UPDATE schema_version SET version = ",
      .settings = "PRAGMA cache_size = -32768; PRAGMA secure_delete = OFF"};
  return format;
}

} // namespace godwit::mapobjects_store
