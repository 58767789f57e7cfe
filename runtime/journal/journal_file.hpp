// Opening the journal's file. Thread: the caller's; blocks on the disk.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "io/sqlite/store_file.hpp"
#include "runtime/journal/records.hpp"

namespace godwit::runtime {

// The tables of the journal and their versions.
//
// The file carries godwit's application id and, as user_version, the version of the journal's own tables. Each
// component's typed tables have a name and a version of their own in `table_version`. All move by the same rule:
// migration i leads from version i to i + 1, all steps of one name in one transaction. A version above the known ones
// is an error: an older program must not write what it does not understand. Thread: the one of the database.

// A component's typed tables. A migration may hold several statements, separated by semicolons.
struct table_definition {
  std::string name;
  std::vector<std::string> migrations;
};

inline constexpr std::int32_t journal_application_id = 0x676f6477; // "godw"

[[nodiscard]] const io::sqlite::store_format& journal_format();

// Refuses tables newer than TABLES knows. Only reads.
[[nodiscard]] io::sqlite::store_result<void> check_tables(io::sqlite::database& db, const std::string& file,
                                                          const std::vector<table_definition>& tables);

// Brings the components' tables to the newest version.
[[nodiscard]] io::sqlite::store_result<void> migrate_tables(io::sqlite::database& db, const std::string& file,
                                                            const std::vector<table_definition>& tables);

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
