// All commands of godwit-sim, in the order of its help.
#pragma once

#include "programs/godwit-sim/command.hpp"

namespace godwit::sim {

[[nodiscard]] command add_vehicle_command(CLI::App& to);
[[nodiscard]] command add_missions_command(CLI::App& to);

inline constexpr add_command all_commands[] = {add_vehicle_command, add_missions_command};

} // namespace godwit::sim
