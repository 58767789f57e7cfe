// The command line of a program with commands: each puts its options in, and one runs when they are read.
//
// Adding a command is a file with an add_command, and a line in the program's commands.hpp. Thread: one.
#pragma once

#include <functional>
#include <vector>

#include <CLI/CLI.hpp>

#include "programs/common/exit_code.hpp"

namespace godwit::programs {

struct command {
  CLI::App* app = nullptr; // belongs to the command line
  std::function<exit_code()> run;
};

using add_command = command (*)(CLI::App& to);

// Runs the one that was named; what the program returns.
[[nodiscard]] inline int run_chosen(const CLI::App& app, const std::vector<command>& commands) {
  for (const auto& each : commands)
    if (app.got_subcommand(each.app))
      return static_cast<int>(each.run());
  return static_cast<int>(exit_code::usage);
}

} // namespace godwit::programs
