#include "runtime/journal/sqlite_error.hpp"

#include <cerrno>

#include <sqlite3.h>

namespace godwit::runtime {

namespace {

journal_errc code_of(const io::sqlite::error& error) {
  switch (error.code) {
  case SQLITE_FULL:
    return journal_errc::disk_full;
  case SQLITE_CORRUPT:
    return journal_errc::corrupt;
  case SQLITE_NOTADB:
    return journal_errc::foreign;
  case SQLITE_READONLY:
  case SQLITE_PERM:
    return journal_errc::read_only;
  default:
    break;
  }
  if (error.system_errno == ENOSPC || error.system_errno == EDQUOT)
    return journal_errc::disk_full;
  if (error.system_errno == EROFS || error.system_errno == EACCES)
    return journal_errc::read_only;
  return journal_errc::io;
}

std::string words_of(journal_errc code, const io::sqlite::error& error) {
  switch (code) {
  case journal_errc::disk_full:
    return "the disk is full";
  case journal_errc::corrupt:
    return "the file is damaged";
  case journal_errc::foreign:
    return "this is not a godwit journal";
  case journal_errc::read_only:
    return "the file or its folder can not be written";
  default:
    break;
  }
  if (error.code == SQLITE_BUSY || error.code == SQLITE_LOCKED)
    return "another program holds the file";
  return io::sqlite::is_programming_error(error) ? "a statement was refused" : "the disk reported an error";
}

std::string remedy_of(journal_errc code, const io::sqlite::error& error) {
  switch (code) {
  case journal_errc::disk_full:
    return "Free space on its file system; a running godwit goes on by itself";
  case journal_errc::corrupt:
    return "Move it away together with its -wal file (the sqlite3 shell's .recover may save its rows), then put back a "
           "copy or start without it";
  case journal_errc::foreign:
    return "Name another file for the journal, or move this one away if nobody needs it";
  case journal_errc::read_only:
    return "Give this user the right to write the file and its folder, and mount the file system for writing";
  default:
    break;
  }
  if (error.code == SQLITE_BUSY || error.code == SQLITE_LOCKED)
    return "End the other program, or let it finish its transaction";
  if (io::sqlite::is_programming_error(error))
    return "This is a mistake in the program that gave the statement; please report it";
  return "Look for disk errors in the kernel's log and check the file system";
}

} // namespace

journal_error from_sqlite(const io::sqlite::error& error, const std::string& file, const std::string& doing) {
  const auto code = code_of(error);
  return {code, file, words_of(code, error) + " (" + error.message + ", while " + doing + ")",
          remedy_of(code, error) + "."};
}

journal_error foreign_file(const std::string& file, const std::string& why) {
  return {journal_errc::foreign, file, "this is not a godwit journal (" + why + ")",
          remedy_of(journal_errc::foreign, {}) + "."};
}

journal_error corrupt_file(const std::string& file, const std::string& why) {
  return {journal_errc::corrupt, file, "the file is damaged (" + why + ")", remedy_of(journal_errc::corrupt, {}) + "."};
}

journal_error closed_journal(const std::string& file) {
  return {journal_errc::closed, file, "the journal is closed", "Nothing to do: the process is ending."};
}

} // namespace godwit::runtime
