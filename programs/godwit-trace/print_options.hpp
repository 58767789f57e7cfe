// The options about what is printed and how, which several commands share.
//
// Errors: a sentence for people. Thread: values.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <tl/expected.hpp>

#include "programs/godwit-trace/message_filter.hpp"
#include "programs/godwit-trace/message_printer.hpp"

namespace godwit::trace_tool {

struct print_options {
  message_filter filter;
  print_form form = print_form::text;
  bool stats = false; // tables in place of messages
};

// As they stand on the command line.
struct print_arguments {
  std::vector<std::string> names;
  std::vector<std::uint8_t> systems;
  std::vector<std::uint8_t> components;
  bool json = false;
  bool stats = false;
};

// TO must live as long as COMMAND.
void add_print_options(CLI::App& command, print_arguments& to);

[[nodiscard]] tl::expected<print_options, std::string> read(const print_arguments& given);

} // namespace godwit::trace_tool
