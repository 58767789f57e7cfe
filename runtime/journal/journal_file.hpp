// Opening the journal's file. Thread: the caller's; blocks on the disk.
#pragma once

#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "io/sqlite/store_file.hpp"
#include "runtime/journal/error.hpp"
#include "runtime/journal/schema.hpp"

namespace godwit::runtime {

using io::sqlite::integrity_check;

struct file_options {
  std::string path;
  std::string vfs;    // empty = SQLite's default
  bool create = true; // false: a journal that is not there is an error
  integrity_check check = integrity_check::quick;
  std::vector<table_definition> tables;
};

// Beside the journal, for what was saved of it when its file was lost.
inline constexpr const char* rescued_suffix = ".rescued";

// PATH, or the file that was saved of it in flight and is gone on with until a person has put it in its place.
[[nodiscard]] std::string journal_in_use(const std::string& path);

// Migrated, the components' tables too, and its run counter has risen.
[[nodiscard]] tl::expected<io::sqlite::store_file, journal_error> open_for_writing(const file_options& options);

// Any number, beside a writer or without one.
[[nodiscard]] tl::expected<io::sqlite::database, journal_error> open_for_reading(const std::string& path,
                                                                                 const std::string& vfs);

[[nodiscard]] tl::expected<void, journal_error> check_integrity(io::sqlite::database& db, const std::string& file,
                                                                integrity_check check);

} // namespace godwit::runtime
