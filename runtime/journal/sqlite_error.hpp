// SQLite's errors in the journal's words: which file, what is wrong, what a person can do.
//
// Thread: any.
#pragma once

#include <string>

#include "io/sqlite/error.hpp"
#include "runtime/journal/error.hpp"

namespace godwit::runtime {

// DOING completes the sentence "... while DOING", e.g. "committing 12 writes".
[[nodiscard]] journal_error from_sqlite(const io::sqlite::error& error, const std::string& file,
                                        const std::string& doing);

// The checks' own findings.
[[nodiscard]] journal_error foreign_file(const std::string& file, const std::string& why);
[[nodiscard]] journal_error corrupt_file(const std::string& file, const std::string& why);
[[nodiscard]] journal_error closed_journal(const std::string& file);

} // namespace godwit::runtime
