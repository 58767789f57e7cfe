#include "io/sqlite/error.hpp"

#include <cerrno>
#include <cstring>

#include <sqlite3.h>

namespace godwit::io::sqlite {

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
