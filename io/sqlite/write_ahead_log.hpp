// Room for the write-ahead log, written before it is needed.
//
// A commit that makes the log longer has to change the file system's own records too: on ext4 an fdatasync then takes
// milliseconds instead of a tenth of one. SQLite writes the log again from its beginning after each checkpoint, so room
// that was filled once stays cheap. The filling is zeros, which no frame's checksum matches: recovery ends before them.
// Thread: the one of the database. Source: https://www.sqlite.org/walformat.html
#pragma once

#include <cstdint>

#include "io/sqlite/database.hpp"

namespace godwit::io::sqlite {

// The database is in WAL mode and nobody else writes. What the log holds already stays as it is.
[[nodiscard]] result<void> reserve_log(database& db, std::int64_t bytes);

} // namespace godwit::io::sqlite
