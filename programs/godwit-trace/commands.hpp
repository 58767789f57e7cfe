// All commands of godwit-trace, in the order of its help.
#pragma once

#include "programs/godwit-trace/command.hpp"

namespace godwit::trace_tool {

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
