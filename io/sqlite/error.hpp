// An error of SQLite as a value.
//
// Thread: plain value, any thread. Source: https://www.sqlite.org/rescode.html
#pragma once

#include <string>

#include <tl/expected.hpp>

struct sqlite3;

namespace godwit::io::sqlite {

struct error {
  int code = 0;         // primary result code, e.g. SQLITE_FULL
  int extended = 0;     // extended result code, e.g. SQLITE_IOERR_FSYNC
  int system_errno = 0; // errno of the call below it; 0 = none
  std::string message;  // SQLite's text, the statement where there is one, and the system's text
};

template <class T>
using result = tl::expected<T, error>;

// True for an error that lies in the text or the values of a statement: trying again can not help.
// False for what comes from the disk, from memory or from other connections.
[[nodiscard]] bool is_programming_error(const error& error);

// Takes the last error of a connection; SQL is the statement concerned or empty.
[[nodiscard]] error last_error(sqlite3* connection, int code, const std::string& sql = {});

} // namespace godwit::io::sqlite
