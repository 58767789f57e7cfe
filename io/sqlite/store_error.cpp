#include "io/sqlite/store_error.hpp"

#include <cerrno>
#include <cstring>

#include <sqlite3.h>

namespace godwit::io::sqlite {

namespace {

store_errc code_of(const error& error) {
  switch (error.code) {
  case SQLITE_FULL:
    return store_errc::disk_full;
  case SQLITE_CORRUPT:
    return store_errc::corrupt;
  case SQLITE_NOTADB:
    return store_errc::foreign;
  case SQLITE_READONLY:
  case SQLITE_PERM:
    return store_errc::read_only;
  default:
    break;
  }
  if (error.system_errno == ENOSPC || error.system_errno == EDQUOT)
    return store_errc::disk_full;
  if (error.system_errno == EROFS || error.system_errno == EACCES)
    return store_errc::read_only;
  return is_programming_error(error) ? store_errc::misuse : store_errc::io;
}

bool is_held(const error& error) { return error.code == SQLITE_BUSY || error.code == SQLITE_LOCKED; }

std::string words_of(store_errc code, const error& error, const store_kind& kind) {
  switch (code) {
  case store_errc::disk_full:
    return "the disk is full";
  case store_errc::corrupt:
    return "the file is damaged";
  case store_errc::foreign:
    return "this is not a godwit " + kind.name;
  case store_errc::read_only:
    return "the file or its folder can not be written";
  case store_errc::misuse:
    return "a statement was refused";
  default:
    return is_held(error) ? "another program holds the file" : "the disk reported an error";
  }
}

std::string remedy_of(store_errc code, const error& error, const store_kind& kind) {
  switch (code) {
  case store_errc::disk_full:
    return "Free space on its file system; a running godwit goes on by itself";
  case store_errc::corrupt:
    return kind.when_corrupt;
  case store_errc::foreign:
    return "Name another file for the " + kind.name + ", or move this one away if nobody needs it";
  case store_errc::read_only:
    return "Give this user the right to write the file and its folder, and mount the file system for writing";
  case store_errc::misuse:
    return "This is a mistake in the program that gave the statement; please report it";
  default:
    return is_held(error) ? "End the other program, or let it finish its transaction"
                          : "Look for disk errors in the kernel's log and check the file system";
  }
}

} // namespace

store_error describe(const error& error, const store_kind& kind, const std::string& file, const std::string& doing) {
  const auto code = code_of(error);
  return {code, file, words_of(code, error, kind) + " (" + error.message + ", while " + doing + ")",
          remedy_of(code, error, kind)};
}

store_error foreign_file(const store_kind& kind, const std::string& file, const std::string& why) {
  return {store_errc::foreign, file, words_of(store_errc::foreign, {}, kind) + " (" + why + ")",
          remedy_of(store_errc::foreign, {}, kind)};
}

store_error corrupt_file(const store_kind& kind, const std::string& file, const std::string& why) {
  return {store_errc::corrupt, file, words_of(store_errc::corrupt, {}, kind) + " (" + why + ")", kind.when_corrupt};
}

store_error newer_file(const store_kind& kind, const std::string& file, const std::string& whose, std::int64_t found,
                       std::int64_t known) {
  return {store_errc::newer, file,
          whose + " has version " + std::to_string(found) + ", this program knows up to " + std::to_string(known),
          "Start the newer godwit that wrote it, or move the " + kind.name + " away"};
}

store_error system_error(const store_kind& kind, const std::string& file, int number, const std::string& doing) {
  return describe(
      {.code = SQLITE_IOERR, .extended = SQLITE_IOERR, .system_errno = number, .message = std::strerror(number)}, kind,
      file, doing);
}

bool may_pass(store_errc code) {
  return code == store_errc::read_only || code == store_errc::disk_full || code == store_errc::io;
}

bool is_programming_error(const error& error) {
  switch (error.code) {
  case SQLITE_ERROR:
  case SQLITE_CONSTRAINT:
  case SQLITE_MISMATCH:
  case SQLITE_MISUSE:
  case SQLITE_RANGE:
  case SQLITE_TOOBIG:
    return true;
  case SQLITE_SCHEMA: // the schema changed under a statement; SQLite prepares it again by itself
  default:
    return false;
  }
}

error last_error(sqlite3* connection, int code, const std::string& sql) {
  error result{.code = code & 0xff, .extended = code, .system_errno = 0, .message = sqlite3_errstr(code)};
  if (connection != nullptr) {
    result.extended = sqlite3_extended_errcode(connection);
    if ((result.extended & 0xff) != result.code) // e.g. an error of binding, which the connection does not keep
      result.extended = code;
    else
      result.message = sqlite3_errmsg(connection);
    // SQLite keeps the errno of an earlier error; it belongs to this one only where the code says so.
    if (result.code == SQLITE_IOERR || result.code == SQLITE_CANTOPEN || result.code == SQLITE_FULL)
      result.system_errno = sqlite3_system_errno(connection);
  }
  if (result.system_errno != 0)
    result.message += std::string(", ") + std::strerror(result.system_errno);
  if (result.extended != result.code)
    result.message += " [code " + std::to_string(result.extended) + "]";
  if (!sql.empty())
    result.message += " in \"" + sql + "\"";
  return result;
}

} // namespace godwit::io::sqlite
