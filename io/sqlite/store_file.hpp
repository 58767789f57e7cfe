// Opening a file that one program keeps: what is there, is it ours, is it whole. Never an empty start over existing
// data.
//
// The file carries an application id and a version; a version above the known ones is refused, because an older program
// must not write what it does not understand. A new file is made under the name PATH.new and moved into place when it
// is complete and on the disk: whatever lies at PATH was complete once, so a file there that is empty or can not be
// read is an error and not a beginning. What a crash leaves of PATH.new holds nothing that anybody was told of and is
// made anew. Thread: the caller's; blocks on the disk.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "io/sqlite/database.hpp"
#include "io/sqlite/lock_file.hpp"
#include "io/sqlite/store_error.hpp"

namespace godwit::io::sqlite {

struct store_format {
  store_kind kind;
  std::int32_t application_id = 0;
  std::vector<std::string> migrations; // the first one makes the tables
  std::string read_version;            // a query
  std::string set_version;             // a statement; the number follows
  std::string settings;                // of a writing connection, beside those of all
};

enum class integrity_check {
  none,
  // Structure of every page and every row, but not that each index agrees with its table. Reads the whole file (about 1
  // GB/s from the page cache); `full` costs several times that.
  quick,
  full,
};

struct store_options {
  std::string path;
  std::string vfs;    // empty = SQLite's default
  bool create = true; // false: a file that is not there is an error
  integrity_check check = integrity_check::none;
  std::function<store_result<void>(database&)>
      inspect; // the caller's own check before anything is changed; may be empty
};

// The lock is given back after the file is closed.
struct store_file {
  lock_file lock;
  database db;
};

// Makes the folder where it is missing and takes the lock. The connection is in WAL mode, synchronous FULL, migrated,
// and leaves checkpoints to the caller.
[[nodiscard]] store_result<store_file> open_for_writing(const store_format& format, const store_options& options);

// Any number, beside a writer or without one. The caller needs no lock.
[[nodiscard]] store_result<database> open_for_reading(const store_format& format, const std::string& path,
                                                      const std::string& vfs);

[[nodiscard]] store_result<void> check_integrity(database& db, const store_kind& kind, const std::string& file,
                                                 integrity_check check);

} // namespace godwit::io::sqlite
