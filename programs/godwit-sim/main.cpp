// godwit-sim: the world outside of godwit, with faults on demand. See `godwit-sim --help`.
#include <csignal>
#include <string>
#include <vector>

#include "programs/godwit-sim/commands.hpp"
#include "programs/godwit-sim/console.hpp"

using namespace godwit::sim;

int main(int argc, char** argv) {
  std::signal(SIGPIPE, SIG_IGN);
  CLI::App app{"Simulates the world around godwit: vehicles and a missions service, with faults on demand.",
               "godwit-sim"};
  app.footer("godwit-sim COMMAND --help shows the options of a command, with examples.");
  app.require_subcommand(1);
  std::vector<command> commands;
  for (const auto add : all_commands)
    commands.push_back(add(app));
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0)
      return app.exit(error);
    say(error.what());
    const auto chosen = app.get_subcommands();
    const auto help = chosen.empty() ? app.help() : chosen.front()->help(app.get_name());
    std::fwrite(help.data(), 1, help.size(), stderr);
    return static_cast<int>(exit_code::usage);
  }
  return godwit::programs::run_chosen(app, commands);
}
