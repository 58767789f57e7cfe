// The command line of a program with commands: each puts its options in, and one runs when they are read.
//
// Adding a command is a file with an add_command, and a line in the program's commands.hpp. Thread: one.
#pragma once

#include <csignal>
#include <cstdio>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

namespace godwit::programs {

// What a program says to the shell when it ends. godwitd says more: runtime/process.hpp. Thread: a value.
enum class exit_code : int {
  ok = 0,
  failed = 1, // it could not do what it was asked; the reason stands on stderr
  usage = 2,  // a mistake on the command line
};

struct command {
  CLI::App* app = nullptr; // belongs to the command line
  std::function<exit_code()> run;
};

using add_command = command (*)(CLI::App& to);

// A sentence about PROGRAM itself, for people, on stderr. Thread: any, a line at a time.
inline void say(std::string_view program, std::string_view sentence) {
  const std::string whole = std::string(program) + ": " + std::string(sentence) + "\n";
  std::fwrite(whole.data(), 1, whole.size(), stderr);
}

enum class on_mistake { says_what, shows_help_too };

// Reads the command line and runs the command that it names; what the program returns.
[[nodiscard]] inline int run_program(CLI::App& app, std::span<const add_command> all, int argc, char** argv,
                                     on_mistake then) {
  std::signal(SIGPIPE, SIG_IGN);
  app.require_subcommand(1);
  std::vector<command> commands;
  for (const auto add : all)
    commands.push_back(add(app));
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0)
      return app.exit(error);
    say(app.get_name(), error.what());
    if (then == on_mistake::shows_help_too) {
      const auto chosen = app.get_subcommands();
      const auto help = chosen.empty() ? app.help() : chosen.front()->help(app.get_name());
      std::fwrite(help.data(), 1, help.size(), stderr);
    }
    return static_cast<int>(exit_code::usage);
  }
  for (const auto& each : commands)
    if (app.got_subcommand(each.app))
      return static_cast<int>(each.run());
  return static_cast<int>(exit_code::usage);
}

} // namespace godwit::programs
