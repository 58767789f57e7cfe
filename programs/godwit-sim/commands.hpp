// All commands of godwit-sim, in the order of its help.
#pragma once

#include <string>
#include <string_view>

#include <tl/expected.hpp>

#include "programs/common/command.hpp"

namespace godwit::sim {

using programs::add_command;
using programs::command;
using programs::exit_code;

[[nodiscard]] command add_vehicle_command(CLI::App& to);
[[nodiscard]] command add_missions_command(CLI::App& to);

inline constexpr add_command all_commands[] = {add_vehicle_command, add_missions_command};

inline void say(std::string_view sentence) { programs::say("godwit-sim", sentence); }

// What is wrong with an option, as a sentence that begins with its name. Thread: any.
[[nodiscard]] inline tl::unexpected<std::string> in_option(const char* option, const std::string& sentence) {
  return tl::unexpected(std::string(option) + ": " + sentence);
}

} // namespace godwit::sim
