// All commands of godwit-eyes, in the order of its help. Thread: one.
#pragma once

#include <functional>

#include <CLI/CLI.hpp>

#include "programs/common/exit_code.hpp"

namespace godwit::eyes {

using programs::exit_code;

struct command {
  CLI::App* app = nullptr;
  std::function<exit_code()> run;
};

using add_command = command (*)(CLI::App& to);

[[nodiscard]] command add_probe_command(CLI::App& to);
[[nodiscard]] command add_look_command(CLI::App& to);
[[nodiscard]] command add_session_command(CLI::App& to);

inline constexpr add_command all_commands[] = {add_probe_command, add_look_command, add_session_command};

} // namespace godwit::eyes
