// All commands of godwit-trace, in the order of its help.
#pragma once

#include <functional>

#include <CLI/CLI.hpp>

#include "programs/common/command.hpp"
#include "programs/godwit-trace/output.hpp"

namespace godwit::trace_tool {

// A command of godwit-trace: it puts its options into the command line, and runs when these are read.
//
// Adding one is a file with such a function, and a line in commands.hpp.
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

[[nodiscard]] command add_tlog_command(CLI::App& to);
[[nodiscard]] command add_link_command(CLI::App& to);
[[nodiscard]] command add_upload_command(CLI::App& to);
[[nodiscard]] command add_download_command(CLI::App& to);
[[nodiscard]] command add_clear_command(CLI::App& to);

// About the program itself.
[[nodiscard]] command add_completion_command(CLI::App& to);
[[nodiscard]] command add_man_command(CLI::App& to);

// About the trace of the actors.
[[nodiscard]] command add_ls_command(CLI::App& to);
[[nodiscard]] command add_log_command(CLI::App& to);
[[nodiscard]] command add_show_command(CLI::App& to);
[[nodiscard]] command add_flow_command(CLI::App& to);
[[nodiscard]] command add_stats_command(CLI::App& to);
[[nodiscard]] command add_crashes_command(CLI::App& to);
[[nodiscard]] command add_flight_command(CLI::App& to);
[[nodiscard]] command add_verify_command(CLI::App& to);
[[nodiscard]] command add_diff_command(CLI::App& to);
[[nodiscard]] command add_export_command(CLI::App& to);
[[nodiscard]] command add_replay_command(CLI::App& to);
[[nodiscard]] command add_bundle_command(CLI::App& to);

inline constexpr add_command all_commands[] = {
    add_ls_command,       add_log_command,    add_show_command,       add_flow_command, add_stats_command,
    add_crashes_command,  add_flight_command, add_verify_command,     add_diff_command, add_replay_command,
    add_export_command,   add_bundle_command, add_tlog_command,       add_link_command, add_upload_command,
    add_download_command, add_clear_command,  add_completion_command, add_man_command};

} // namespace godwit::trace_tool
