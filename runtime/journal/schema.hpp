// The tables of the journal and their versions.
//
// The file carries godwit's application id and, as user_version, the version of the journal's own tables. Each
// component's typed tables have a name and a version of their own in `table_version`. All move by the same rule:
// migration i leads from version i to i + 1, all steps of one name in one transaction. A version above the known ones
// is an error: an older program must not write what it does not understand. Thread: the one of the database.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/sqlite/store_file.hpp"

namespace godwit::runtime {

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

} // namespace godwit::runtime
