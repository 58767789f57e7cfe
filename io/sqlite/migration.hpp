// Tables move from version to version: step i leads from version i to i + 1.
//
// Thread: the one of the database.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/sqlite/database.hpp"

namespace godwit::io::sqlite {

// Runs the steps above FOUND and then SET_VERSION, in one transaction. A step may hold several statements.
[[nodiscard]] result<void> run_migrations(database& db, const std::vector<std::string>& steps, std::int64_t found,
                                          const std::string& set_version);

} // namespace godwit::io::sqlite
