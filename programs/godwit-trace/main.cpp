// godwit-trace: what the actors did, and MAVLink logs and links, made readable. See `godwit-trace --help`.
#include <csignal>
#include <optional>
#include <vector>

#include <unistd.h>

#include "programs/godwit-trace/commands.hpp"
#include "programs/godwit-trace/output.hpp"

namespace {

using namespace godwit::trace_tool;

int run(CLI::App& app, const std::vector<command>& commands, console& to, bool may_page) {
  for (const auto& each : commands)
    if (app.got_subcommand(each.app)) {
      std::optional<pager> shown;
      if (may_page && to.is_terminal && each.is_paged && each.is_paged())
        shown.emplace(STDOUT_FILENO);
      auto code = each.run(to);
      to.out.flush();
      if (const auto failure = to.out.failure(); !failure.empty()) {
        to.say("the output can not be written: " + failure);
        code = exit_code::failed;
      }
      return static_cast<int>(code);
    }
  return static_cast<int>(exit_code::usage);
}

} // namespace

int main(int argc, char** argv) {
  std::signal(SIGPIPE, SIG_IGN);
  output out(STDOUT_FILENO);
  output words(STDERR_FILENO);
  console to{out, words, ::isatty(STDOUT_FILENO) != 0};
  CLI::App app{"Shows what the actors of godwit did, what MAVLink logs hold, and what arrives on MAVLink links.",
               "godwit-trace"};
  app.footer("godwit-trace COMMAND --help shows the options of a command, with examples.");
  app.require_subcommand(1);
  bool has_no_pager = false;
  app.add_flag("--no-pager", has_no_pager, "On a terminal, print and start no pager (PAGER, or less)");
  std::vector<command> commands;
  for (const auto add : all_commands)
    commands.push_back(add(app));
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0)
      return app.exit(error);
    to.say(error.what());
    const auto chosen = app.get_subcommands();
    words.text() += '\n' + (chosen.empty() ? app.help() : chosen.front()->help(app.get_name()));
    return static_cast<int>(exit_code::usage);
  }
  return run(app, commands, to, !has_no_pager);
}
