#include "io/sqlite/write_ahead_log.hpp"

#include <algorithm>
#include <vector>

#include <sqlite3.h>

namespace godwit::io::sqlite {

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
