// A consistent copy of a database, also while another process writes it.
//
// The copy is one moment of the original, and is whole in one file: nothing of it lies in a -wal. Writers of the
// original are not held up. Errors: those of SQLite; the copy is then not to be used. Blocks on the disk. Thread: one
// at a time. Source: https://www.sqlite.org/backup.html
#pragma once

#include <string>

#include "io/sqlite/database.hpp"

namespace godwit::io::sqlite {

// The file TO becomes the copy, whatever was in it.
[[nodiscard]] result<void> back_up(database& from, const std::string& to);

} // namespace godwit::io::sqlite
