// A command of godwit-trace: it puts its options into the command line, and runs when these are read.
//
// Adding one is a file with such a function, and a line in commands.hpp.
#pragma once

#include <functional>

#include <CLI/CLI.hpp>

#include "programs/common/exit_code.hpp"
#include "programs/godwit-trace/output.hpp"

namespace godwit::trace_tool {

using programs::exit_code;

struct command {
  CLI::App* app = nullptr; // belongs to the command line
  std::function<exit_code(console&)> run;
  // What it prints is long, comes to an end, and is for people: on a terminal a pager shows it. Asked after the
  // options; none: never.
  std::function<bool()> is_paged = {};
};

inline bool always() { return true; }

using add_command = command (*)(CLI::App& to);

} // namespace godwit::trace_tool
