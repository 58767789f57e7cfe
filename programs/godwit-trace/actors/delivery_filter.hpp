// Which deliveries are wanted: by actor, sender, type, text in the message, id, cause and how they ended.
//
// `*` stands for any letters in names, capitals count; several of one kind are joined by "or", kinds by "and".
// Errors: none; an outcome that is mistyped is refused by the command line. Thread: one at a time.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "runtime/trace/reading/delivery.hpp"
#include "runtime/trace/reading/name_table.hpp"

namespace godwit::trace_tool {

struct filter_arguments {
  std::vector<std::string> actors;
  std::vector<std::string> senders;
  std::vector<std::string> types;
  std::vector<std::string> outcomes;
  std::string text;
  std::optional<std::uint64_t> cause;
};

// TO must live as long as COMMAND.
void add_filter_arguments(CLI::App& command, filter_arguments& to);

class delivery_filter {
public:
  explicit delivery_filter(filter_arguments wanted) : wanted_(std::move(wanted)) {}

  [[nodiscard]] bool wants(const runtime::delivery& each, const runtime::name_table& names);

private:
  enum class answer : std::uint8_t { unknown, yes, no };
  using answers = std::vector<answer>; // by the number of a name: a pattern is tried once for each name

  [[nodiscard]] static bool is_one_of(const std::vector<std::string>& patterns, std::uint32_t number,
                                      const runtime::name_table& names, answers& known);

  filter_arguments wanted_;
  answers actors_;
  answers senders_;
  answers types_;
};

} // namespace godwit::trace_tool
