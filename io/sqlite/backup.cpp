#include "io/sqlite/backup.hpp"

#include <sqlite3.h>

namespace godwit::io::sqlite {

result<void> back_up(database& from, const std::string& to) {
  auto copy = database::open(to, {.mode = open_mode::create});
  if (!copy)
    return tl::unexpected(copy.error());
  auto* const backup = sqlite3_backup_init(copy->handle(), "main", from.handle(), "main");
  if (backup == nullptr)
    return tl::unexpected(last_error(copy->handle(), sqlite3_errcode(copy->handle())));
  constexpr int all_pages = -1;
  const int code = sqlite3_backup_step(backup, all_pages);
  sqlite3_backup_finish(backup);
  if (code != SQLITE_DONE)
    return tl::unexpected(last_error(copy->handle(), code));
  return copy->exec("PRAGMA journal_mode = DELETE"); // what it brings along of the original asks for a -wal
}

} // namespace godwit::io::sqlite
