// godwit-eyes: looks at the camera for godwitd, which starts it. By hand: see `godwit-eyes --help`.
#include "programs/godwit-eyes/commands.hpp"
#include "programs/godwit-eyes/self_limits.hpp"

using namespace godwit::eyes;

int main(int argc, char** argv) {
  if (const char* const objection = limit_own_memory())
    say(objection);
  CLI::App app{
      "Looks at a camera and finds what moves on the ground. godwitd starts it by itself when camera.uri is set.",
      "godwit-eyes"};
  app.footer("godwit-eyes COMMAND --help shows the options of a command.");
  return godwit::programs::run_program(app, all_commands, argc, argv, godwit::programs::on_mistake::says_what);
}
