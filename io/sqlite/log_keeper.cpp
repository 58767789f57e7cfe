#include "io/sqlite/log_keeper.hpp"

#include <algorithm>
#include <vector>

#include <sqlite3.h>

namespace godwit::io::sqlite {

log_keeper::log_keeper(database& db, log_bounds bounds)
    : db_(db), bounds_(bounds), page_bytes_(db.query_integer("PRAGMA page_size").value_or(4096)) {
  sqlite3_wal_hook(db_.handle(), &log_keeper::count_frames, this);
  // Only for speed: on a disk too full for it commits still work while they fit.
  static_cast<void>(reserve_log(db_, bounds.long_bytes + bounds.long_bytes / 4));
}

log_keeper::~log_keeper() { sqlite3_wal_hook(db_.handle(), nullptr, nullptr); }

void log_keeper::look_after(bool busy) {
  const auto grown_bytes = (frames_ - moved_frames_) * page_bytes_;
  if (grown_bytes < (busy ? bounds_.very_long_bytes : bounds_.long_bytes))
    return;
  int in_log = 0;
  int moved = 0;
  const int code = sqlite3_wal_checkpoint_v2(db_.handle(), "main", SQLITE_CHECKPOINT_PASSIVE, &in_log, &moved);
  const bool whole = code == SQLITE_OK && in_log == moved;
  moved_frames_ = whole ? 0 : frames_;
  if (whole)
    frames_ = 0; // the next commit begins the log anew
}

void log_keeper::close() { static_cast<void>(db_.exec("PRAGMA wal_checkpoint(TRUNCATE)")); }

int log_keeper::count_frames(void* self, sqlite3*, const char*, int frames) {
  auto& keeper = *static_cast<log_keeper*>(self);
  keeper.frames_ = frames;
  if (frames < keeper.moved_frames_)
    keeper.moved_frames_ = 0;
  return SQLITE_OK;
}

namespace {

constexpr std::int64_t step_bytes = 256 * 1024;

int fill_with_zeros(sqlite3_file* log, std::int64_t bytes) {
  sqlite3_int64 size = 0;
  if (const int code = log->pMethods->xFileSize(log, &size); code != SQLITE_OK)
    return code;
  const std::vector<char> zeros(step_bytes);
  for (std::int64_t offset = size; offset < bytes; offset += step_bytes) {
    const auto count = static_cast<int>(std::min(step_bytes, bytes - offset));
    if (const int code = log->pMethods->xWrite(log, zeros.data(), count, offset); code != SQLITE_OK)
      return code;
  }
  return size < bytes ? log->pMethods->xSync(log, SQLITE_SYNC_NORMAL) : SQLITE_OK;
}

} // namespace

result<void> reserve_log(database& db, std::int64_t bytes) {
  // The log is opened by the first reading of the database; the handle exists from then on.
  if (auto opened = db.query_integer("SELECT count(*) FROM sqlite_schema"); !opened)
    return tl::unexpected(std::move(opened.error()));
  sqlite3_file* log = nullptr;
  int code = sqlite3_file_control(db.handle(), "main", SQLITE_FCNTL_JOURNAL_POINTER, &log);
  if (code == SQLITE_OK && log != nullptr && log->pMethods != nullptr)
    code = fill_with_zeros(log, bytes);
  if (code != SQLITE_OK)
    return tl::unexpected(last_error(nullptr, code));
  return {};
}

} // namespace godwit::io::sqlite
