// All commands of godwit-sim, in the order of its help.
#pragma once

#include "programs/common/command.hpp"

namespace godwit::sim {

using programs::add_command;
using programs::command;
using programs::exit_code;

[[nodiscard]] command add_vehicle_command(CLI::App& to);
[[nodiscard]] command add_missions_command(CLI::App& to);

inline constexpr add_command all_commands[] = {add_vehicle_command, add_missions_command};

} // namespace godwit::sim
