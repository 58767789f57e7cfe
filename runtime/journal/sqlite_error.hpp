// Errors of the file in the journal's words.
//
// Thread: any.
#pragma once

#include <string>

#include "io/sqlite/store_error.hpp"
#include "runtime/journal/records.hpp"

namespace godwit::runtime {

[[nodiscard]] journal_error from_store(const io::sqlite::store_error& error);

// DOING completes the sentence "... while DOING", e.g. "reading".
[[nodiscard]] journal_error from_sqlite(const io::sqlite::error& error, const std::string& file,
                                        const std::string& doing);

[[nodiscard]] journal_error closed_journal(const std::string& file);

} // namespace godwit::runtime
