// All commands of godwit-eyes, in the order of its help. Thread: one.
#pragma once

#include <string>
#include <string_view>

#include "programs/common/command.hpp"

namespace godwit::eyes {

using programs::add_command;
using programs::command;
using programs::exit_code;

[[nodiscard]] command add_probe_command(CLI::App& to);
[[nodiscard]] command add_look_command(CLI::App& to);
[[nodiscard]] command add_session_command(CLI::App& to);

inline constexpr add_command all_commands[] = {add_probe_command, add_look_command, add_session_command};

inline void say(std::string_view sentence) { programs::say("godwit-eyes", sentence); }

} // namespace godwit::eyes
