// A replay in words: where an actor does something else than it did. Thread: pure.
#pragma once

#include <string>

#include "programs/godwit-trace/actors/text_forms.hpp"
#include "runtime/replay/replayer.hpp"

namespace godwit::trace_tool {

// Several lines, with the input at which it shows, what was expected and what was produced.
void append_deviation(std::string& out, const runtime::deviation& what, const paint& colours);
// An object on one line.
void append_deviation_json(std::string& out, const runtime::deviation& what);
// An input, what the actor sent of it then and what it sends now.
void append_step(std::string& out, const runtime::replay_step& step, const paint& colours);
// How much was replayed, and what was not.
[[nodiscard]] std::string summary_text(const runtime::replay_summary& summary);

} // namespace godwit::trace_tool
