// Runs a command of godwit-trace as its command line would.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "programs/godwit-trace/commands.hpp"
#include "tests/programs/godwit-trace/tool_fixture.hpp"

namespace godwit::trace_tool::test {

struct command_result {
  exit_code code = exit_code::ok;
  std::string out;
  std::string words;
};

inline command_result run_command(add_command add, std::vector<std::string> arguments) {
  CLI::App app;
  const auto made = add(app);
  std::ranges::reverse(arguments); // as CLI11 takes them
  kept_console console;
  command_result result;
  try {
    made.app->parse(arguments);
    result.code = made.run(console.to);
  } catch (const CLI::ParseError& error) {
    result.code = exit_code::usage;
    console.to.say(error.what());
  }
  result.out = console.out();
  result.words = console.words();
  return result;
}

} // namespace godwit::trace_tool::test
