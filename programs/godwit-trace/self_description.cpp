// godwit-trace completion, godwit-trace man: what a shell and `man` know of the program, made of the same words as its
// --help, so that they can not disagree.
#include <algorithm>

#include "programs/godwit-trace/commands.hpp"

namespace godwit::trace_tool {

namespace {

std::vector<const CLI::App*> commands_of(const CLI::App& program) {
  const auto all = program.get_subcommands([](const CLI::App*) { return true; });
  return {all.begin(), all.end()};
}

// "--from --to -f"
std::string words_of(const CLI::App& command) {
  std::string result;
  for (const auto* each : command.get_options()) {
    for (const auto& name : each->get_lnames())
      result += (result.empty() ? "--" : " --") + name;
    for (const auto& name : each->get_snames())
      result += (result.empty() ? "-" : " -") + name;
  }
  return result;
}

void append_bash(std::string& out, const CLI::App& program) {
  std::string names;
  out += "_godwit_trace() {\n  local current=${COMP_WORDS[COMP_CWORD]} words=\n  case ${COMP_WORDS[1]} in\n";
  for (const auto* each : commands_of(program)) {
    names += (names.empty() ? "" : " ") + each->get_name();
    out += "  " + each->get_name() + ") words='" + words_of(*each) + "' ;;\n";
  }
  out += "  esac\n  ((COMP_CWORD == 1)) && words='" + names +
         " --help'\n  mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$current\")\n"
         "  [[ $current == -* ]] || ((COMP_CWORD == 1)) || mapfile -t COMPREPLY < <(compgen -f -- \"$current\")\n}\n"
         "complete -o filenames -F _godwit_trace godwit-trace\n";
}

// zsh takes the functions of bash.
void append_zsh(std::string& out, const CLI::App& program) {
  out += "#compdef godwit-trace\nautoload -U +X bashcompinit && bashcompinit\n";
  append_bash(out, program);
}

// Text in roff: a backslash is doubled, and a line never begins with a dot or an apostrophe.
std::string roff(const std::string& text) {
  std::string result;
  bool is_line_begin = true;
  for (const char c : text) {
    if (is_line_begin && (c == '.' || c == '\''))
      result += "\\&";
    result += c == '\\' ? "\\\\" : c == '-' ? "\\-" : std::string(1, c);
    is_line_begin = c == '\n';
  }
  return result;
}

void append_option(std::string& out, const CLI::Option& each) {
  std::string names;
  for (const auto& name : each.get_snames())
    names += (names.empty() ? "-" : ", -") + name;
  for (const auto& name : each.get_lnames())
    names += (names.empty() ? "--" : ", --") + name;
  if (names.empty())
    names = each.get_name(true);
  const auto type = each.get_type_size() == 0 ? std::string() : " " + each.get_type_name();
  out += ".TP\n\\fB" + roff(names) + "\\fR" + (each.get_positional() ? std::string() : roff(type)) + '\n' +
         roff(each.get_description()) + '\n';
}

void append_man(std::string& out, const CLI::App& program) {
  out += ".TH GODWIT\\-TRACE 1 \"\" godwit\n.SH NAME\ngodwit\\-trace \\- " + roff(program.get_description()) +
         "\n.SH SYNOPSIS\n.B godwit\\-trace\n.I COMMAND\n[\\fIOPTION\\fR]...\n.SH COMMANDS\n";
  for (const auto* each : commands_of(program)) {
    out += ".SS " + each->get_name() + '\n' + roff(each->get_description()) + '\n';
    for (const auto* option : each->get_options())
      append_option(out, *option);
    out += ".PP\n.nf\n" + roff(each->get_footer()) + "\n.fi\n";
  }
  out += ".SH EXIT STATUS\n0: done. 1: it could not be done, or what was looked for is not so. 2: a mistake on the "
         "command "
         "line.\n";
}

} // namespace

command add_completion_command(CLI::App& to) {
  auto* const app = to.add_subcommand("completion", "Prints what makes a shell complete the words of this program.");
  const auto shell = std::make_shared<std::string>("bash");
  app->add_option("SHELL", *shell, "bash or zsh")->check(CLI::IsMember({"bash", "zsh"}))->required();
  app->footer(R"(Examples:
  godwit-trace completion bash > /etc/bash_completion.d/godwit-trace
  godwit-trace completion zsh > /usr/local/share/zsh/site-functions/_godwit-trace)");
  return {app, [shell, &to](console& into) {
            (*shell == "bash" ? append_bash : append_zsh)(into.out.text(), to);
            return exit_code::ok;
          }};
}

command add_man_command(CLI::App& to) {
  auto* const app = to.add_subcommand("man", "Prints the manual page of this program.");
  app->footer(R"(Examples:
  godwit-trace man | man -l -
  godwit-trace man > /usr/local/share/man/man1/godwit-trace.1)");
  return {app, [&to](console& into) {
            append_man(into.out.text(), to);
            return exit_code::ok;
          }};
}

} // namespace godwit::trace_tool
