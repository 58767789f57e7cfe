// Opening the journal's file: what is there, is it ours, is it whole. Never an empty start over existing data.
//
// A new journal is made under the name PATH.new and moved into place when it is complete and on the disk: whatever lies
// at PATH was complete once, so a file there that is empty or can not be read is an error and not a beginning. What a
// crash leaves of PATH.new holds nothing that anybody was told of and is made anew. Thread: the caller's; blocks on the
// disk.
#pragma once

#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "io/sqlite/database.hpp"
#include "runtime/journal/error.hpp"
#include "runtime/journal/schema.hpp"

namespace godwit::runtime {

enum class integrity_check {
  none,
  // Structure of every page and every row, but not that each index agrees with its table. Reads the whole file (about 1
  // GB/s from the page cache): the default, because integrity_check costs several times that and the journal's tables
  // are nearly all WITHOUT ROWID, which have no second copy to agree with.
  quick,
  full,
};

struct file_options {
  std::string path;
  std::string vfs;    // empty = SQLite's default
  bool create = true; // false: a journal that is not there is an error
  integrity_check check = integrity_check::quick;
  std::vector<table_definition> tables;
};

// The folder is there afterwards. Only where nothing is in the way.
[[nodiscard]] tl::expected<void, journal_error> make_folder_of(const std::string& path);

// The caller holds the lock file. The connection is in WAL mode, synchronous FULL, migrated, and its run counter has
// risen.
[[nodiscard]] tl::expected<io::sqlite::database, journal_error> open_for_writing(const file_options& options);

// Any number, beside a writer or without one. The caller needs no lock.
[[nodiscard]] tl::expected<io::sqlite::database, journal_error> open_for_reading(const std::string& path,
                                                                                 const std::string& vfs);

[[nodiscard]] tl::expected<void, journal_error> check_integrity(io::sqlite::database& db, const std::string& file,
                                                                integrity_check check);

} // namespace godwit::runtime
