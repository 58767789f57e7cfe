// What `verify` asks of the journal beside a trace. The journal may be in use by a godwitd that runs.
//
// Errors: sentences for people. Thread: blocks on the disk.
#pragma once

#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "invariants/journal_record.hpp"

namespace godwit::trace_tool {

// ACTORS: of the trace, whose dead letters are read.
[[nodiscard]] tl::expected<invariants::journal_record, std::string>
read_journal_record(const std::string& journal, const std::vector<std::string>& actors);

} // namespace godwit::trace_tool
