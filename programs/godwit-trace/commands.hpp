// All commands of godwit-trace, in the order of its help.
#pragma once

#include "programs/godwit-trace/command.hpp"

namespace godwit::trace_tool {

[[nodiscard]] command add_tlog_command(CLI::App& to);
[[nodiscard]] command add_link_command(CLI::App& to);
[[nodiscard]] command add_upload_command(CLI::App& to);
[[nodiscard]] command add_download_command(CLI::App& to);
[[nodiscard]] command add_clear_command(CLI::App& to);

inline constexpr add_command all_commands[] = {add_tlog_command, add_link_command, add_upload_command,
                                               add_download_command, add_clear_command};

} // namespace godwit::trace_tool
