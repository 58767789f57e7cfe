// The rows of the audit in the journal: 100,000 of them, and who is refused often displaces nobody.
//
//   kind     | rows   | when there are more
//   ---------+--------+-------------------------------------------------------------------
//   act      | 60,000 | whoever has the most of them loses the oldest: everybody keeps a fair share
//   refusal  | 35,000 | the same
//   stranger |  5,000 | the oldest
//
// A row is written in the transaction of its event, and what is too much is deleted every trimmed_each rows, so that
// there are that many more at times. Thread: those of the journal and of the reader.
#pragma once

#include <cstdint>

#include "actors/operator_bridge/audit.hpp"
#include "io/sqlite/database.hpp"
#include "runtime/journal/journal_file.hpp"
#include "runtime/journal/records.hpp"

namespace godwit::operator_bridge {

struct audit_bounds {
  std::int64_t acts = 60'000;
  std::int64_t refusals = 35'000;
  std::int64_t strangers = 5'000;
  std::uint64_t trimmed_each = 128;
};

[[nodiscard]] const runtime::table_definition& audit_table();

// Into the transaction of WRITE.
void put_row(runtime::journal_write& write, const audit_row& row, const audit_bounds& most = {});

// The newest rows before a number.
[[nodiscard]] io::sqlite::result<audit_page> read_page(io::sqlite::database& journal, const audit_query& wanted);

} // namespace godwit::operator_bridge
