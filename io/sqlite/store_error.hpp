// What can go wrong with a file that one program keeps, in words for people: which file, what is wrong, what a person
// can do about it.
//
// Thread: plain value, any thread.
#pragma once

#include <cstdint>
#include <string>

#include <tl/expected.hpp>

struct sqlite3;

namespace godwit::io::sqlite {

// An error of SQLite as a value.
//
// Thread: plain value, any thread. Source: https://www.sqlite.org/rescode.html
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

enum class store_errc {
  locked,    // another process writes this file
  missing,   // asked to open an existing file, there is none
  foreign,   // the file is something else
  newer,     // written by a later version of the program
  corrupt,   // the file is damaged
  read_only, // the file or its folder can not be written
  disk_full, // no space left
  io,        // the disk reported an error, or another program holds the file
  misuse,    // a statement was refused; trying again can not help
};

struct store_error {
  store_errc code{};
  std::string file;   // the path concerned
  std::string what;   // what is wrong, with the detail that SQLite or the system gave
  std::string remedy; // what a person can do about it; a sentence without its full stop
};

template <class T>
using store_result = tl::expected<T, store_error>;

// How people call the file, and what they can do when it is damaged.
struct store_kind {
  std::string name; // "journal"
  std::string when_corrupt;
};

// DOING completes the sentence "... while DOING", e.g. "committing 12 writes".
[[nodiscard]] store_error describe(const error& error, const store_kind& kind, const std::string& file,
                                   const std::string& doing);

// The checks' own findings.
[[nodiscard]] store_error foreign_file(const store_kind& kind, const std::string& file, const std::string& why);
[[nodiscard]] store_error corrupt_file(const store_kind& kind, const std::string& file, const std::string& why);
// WHOSE version: the file's or a table's.
[[nodiscard]] store_error newer_file(const store_kind& kind, const std::string& file, const std::string& whose,
                                     std::int64_t found, std::int64_t known);

// An error of the system's; NUMBER is its errno.
[[nodiscard]] store_error system_error(const store_kind& kind, const std::string& file, int number,
                                       const std::string& doing);

// The disk refuses for now: full, read-only, an I/O error, a lock. The same may work later.
[[nodiscard]] bool may_pass(store_errc code);

} // namespace godwit::io::sqlite
