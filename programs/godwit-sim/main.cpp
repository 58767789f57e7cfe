// godwit-sim: the world outside of godwit, with faults on demand. See `godwit-sim --help`.
#include "programs/godwit-sim/commands.hpp"

using namespace godwit::sim;

int main(int argc, char** argv) {
  CLI::App app{"Simulates the world around godwit: vehicles and a missions service, with faults on demand.",
               "godwit-sim"};
  app.footer("godwit-sim COMMAND --help shows the options of a command, with examples.");
  return godwit::programs::run_program(app, all_commands, argc, argv, godwit::programs::on_mistake::shows_help_too);
}
