// What godwit-drill can be told. Thread: one.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "programs/godwit-drill/flights/flight_drill.hpp"

namespace godwit::drill {

struct runtime_arguments {
  std::uint64_t messages = 1'000'000;
  std::uint64_t crashes = 1'000;
  std::uint64_t seed = 1;
  std::string config_file;
  std::string json_file;
  std::string journal_file;
  std::string trace_folder;
};

// They are filled in while the command line is read.
void add_runtime_command(CLI::App& app, runtime_arguments& given);
// One for each drill of flights; CHOSEN is set by the one that is named.
void add_flight_commands(CLI::App& app, flight_drill_options& given, std::optional<flight_drill>& chosen);

} // namespace godwit::drill
