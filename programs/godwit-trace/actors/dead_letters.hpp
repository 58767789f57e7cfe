// Messages that were given up because they crashed their handler again and again: they are in the journal, and the
// trace has the crashes.
//
// Errors: sentences for people. Thread: pure, but for reading the file.
#pragma once

#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "invariants/invariant.hpp"
#include "programs/godwit-trace/actors/text_forms.hpp"
#include "runtime/journal/records.hpp"

namespace godwit::trace_tool {

struct given_up {
  std::string actor;
  runtime::dead_letter letter;
};

// Of the ACTORS, in the order of time. JOURNAL may be in use by a godwitd that runs.
[[nodiscard]] tl::expected<std::vector<given_up>, std::string>
read_dead_letters(const std::string& journal, const std::vector<std::string>& actors);

void append_dead_letter(std::string& out, const given_up& each, const paint& colours);
// An object on one line.
void append_dead_letter_json(std::string& out, const given_up& each);

// What `verify` asks of the journal beside a trace. The journal may be in use by a godwitd that runs.
//
// Errors: sentences for people. Thread: blocks on the disk.

// ACTORS: of the trace, whose dead letters are read.
[[nodiscard]] tl::expected<invariants::journal_record, std::string>
read_journal_record(const std::string& journal, const std::vector<std::string>& actors);

} // namespace godwit::trace_tool
