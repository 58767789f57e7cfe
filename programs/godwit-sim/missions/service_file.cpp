#include "programs/godwit-sim/missions/service_file.hpp"

namespace godwit::sim::missions {
namespace {

constexpr std::int64_t schema_number = 2;

// A row of `delivered` is there once for its key, however often it is sent. What is left of a mission that was deleted
// stays for those who want to look at it.
constexpr const char* schema = R"sql(
CREATE TABLE missions(
  mission_id     TEXT PRIMARY KEY,
  revision       INTEGER NOT NULL,
  last_revision  INTEGER NOT NULL,           -- that was given to the mission or to an assignment
  text           TEXT NOT NULL,              -- the document
  last_report_no INTEGER NOT NULL DEFAULT 0,
  map_epoch      INTEGER NOT NULL DEFAULT 0, -- rises when the objects are replaced: older pages are not known any more
  deleted_at     TEXT);
CREATE TABLE items(                          -- all that ever were in a mission: an id is never used for another one
  mission_id TEXT NOT NULL,
  item_id    TEXT NOT NULL,
  text       TEXT NOT NULL,
  PRIMARY KEY(mission_id, item_id)) WITHOUT ROWID;
CREATE TABLE assignments(
  assignment_id TEXT PRIMARY KEY,
  mission_id    TEXT NOT NULL,
  revision      INTEGER NOT NULL,
  text          TEXT NOT NULL,
  outcome       TEXT);                       -- NULL: no answer yet
CREATE INDEX assignments_by_revision ON assignments(mission_id, revision);
CREATE TABLE map_objects(
  seq        INTEGER PRIMARY KEY AUTOINCREMENT,
  mission_id TEXT NOT NULL,
  object_id  TEXT NOT NULL,
  text       TEXT,                           -- NULL: it is not on the map any more
  UNIQUE(mission_id, object_id));
CREATE INDEX map_objects_by_mission ON map_objects(mission_id);
CREATE TABLE delivered(
  seq        INTEGER PRIMARY KEY,
  mission_id TEXT NOT NULL,
  kind       TEXT NOT NULL,
  id         TEXT NOT NULL,
  text       TEXT NOT NULL,
  deliveries INTEGER NOT NULL DEFAULT 1,
  differing  INTEGER NOT NULL DEFAULT 0,
  UNIQUE(mission_id, kind, id));
CREATE INDEX delivered_in_order ON delivered(mission_id, kind);
CREATE TABLE answers(
  idempotency_key TEXT PRIMARY KEY,
  digest          TEXT NOT NULL,             -- of verb, path and body
  status          INTEGER NOT NULL,
  content_type    TEXT NOT NULL,
  body            TEXT NOT NULL,
  made_s          INTEGER NOT NULL,          -- since 1970
  replays         INTEGER NOT NULL DEFAULT 0);
)sql";

} // namespace

tl::expected<std::unique_ptr<service_file>, std::string> service_file::open(const std::string& path) {
  auto opened = io::sqlite::database::open(path, {.mode = io::sqlite::open_mode::create});
  if (!opened)
    return tl::unexpected(path + " can not be opened: " + opened.error().message);
  std::unique_ptr<service_file> file(new service_file(*std::move(opened)));
  if (auto prepared = file->prepare_schema(); !prepared)
    return tl::unexpected(path + prepared.error());
  return file;
}

tl::expected<void, std::string> service_file::prepare_schema() {
  const auto failed = [](const io::sqlite::error& error) {
    return tl::unexpected(" can not be used as the file of a missions service: " + error.message);
  };
  if (auto tuned = db_.exec("PRAGMA journal_mode=WAL; PRAGMA synchronous=NORMAL"); !tuned)
    return failed(tuned.error());
  const auto found = db_.query_integer("PRAGMA user_version");
  const auto tables = db_.query_integer("SELECT COUNT(*) FROM sqlite_schema");
  if (!found || !tables)
    return failed(!found ? found.error() : tables.error());
  if (*found == schema_number)
    return {};
  if (*found != 0 || *tables != 0)
    return tl::unexpected(std::string(" is the file of another program, or of another version of this one: name a file "
                                      "that does not exist yet"));
  const auto made =
      db_.exec("BEGIN; " + std::string(schema) + "PRAGMA user_version=" + std::to_string(schema_number) + "; COMMIT");
  if (!made)
    return failed(made.error());
  return {};
}

io::sqlite::statement* service_file::prepare(std::string_view sql) {
  if (error_)
    return nullptr;
  auto got = statements_.get(sql);
  if (got)
    return *got;
  error_ = std::move(got.error());
  return nullptr;
}

bool service_file::step(io::sqlite::statement& prepared) {
  auto row = prepared.step();
  if (!row)
    error_ = std::move(row.error());
  return row && *row;
}

void service_file::rollback() {
  if (db_.in_transaction())
    static_cast<void>(db_.exec("ROLLBACK")); // that it fails means that SQLite has done it already
}

bool service_file::commit() {
  run("COMMIT");
  if (!error_)
    return true;
  rollback();
  return false;
}

std::string service_file::take_error() {
  auto sentence = error_ ? std::move(error_->message) : std::string();
  error_.reset();
  return sentence;
}

} // namespace godwit::sim::missions
