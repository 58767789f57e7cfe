// godwit-eyes: looks at the camera for godwitd, which starts it. By hand: see `godwit-eyes --help`.
#include <csignal>
#include <string>
#include <vector>

#include "programs/godwit-eyes/commands.hpp"
#include "programs/godwit-eyes/console.hpp"
#include "programs/godwit-eyes/self_limits.hpp"

using namespace godwit::eyes;

int main(int argc, char** argv) {
  if (const char* const objection = limit_own_memory())
    say(objection);
  std::signal(SIGPIPE, SIG_IGN);
  CLI::App app{
      "Looks at a camera and finds what moves on the ground. godwitd starts it by itself when camera.uri is set.",
      "godwit-eyes"};
  app.footer("godwit-eyes COMMAND --help shows the options of a command.");
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
    return static_cast<int>(exit_code::usage);
  }
  return godwit::programs::run_chosen(app, commands);
}
