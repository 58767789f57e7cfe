// What all commands about the actors' trace take: which trace, which part of it, and how it is printed.
//
// Errors: sentences for people. Thread: one at a time.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <tl/expected.hpp>

#include "programs/godwit-trace/output.hpp"
#include "runtime/trace/reading/delivery.hpp"
#include "runtime/trace/reading/ordered_reader.hpp"

namespace godwit::trace_tool {

// As they stand on the command line.
struct trace_arguments {
  std::vector<std::string> paths;
  std::string from;
  std::string to;
  std::optional<std::uint64_t> run;
  bool json = false;
};

// TO must live as long as COMMAND.
void add_trace_arguments(CLI::App& command, trace_arguments& to);

// A trace that is being read, in order of time.
struct opened_trace {
  opened_trace(std::vector<runtime::trace_file> files, runtime::time_span_ns wanted)
      : reader(std::move(files), names, wanted), ordered(reader), span(wanted) {}

  runtime::name_table names;
  runtime::trace_reader reader;
  runtime::ordered_reader ordered;
  runtime::time_span_ns span;
};

// Once for each pass: what has been read is gone.
[[nodiscard]] tl::expected<std::unique_ptr<opened_trace>, std::string> open_trace(const trace_arguments& given,
                                                                                  console& to);

// Says on TO.words what the trace does not hold, at most a few sentences.
void report_losses(const runtime::trace_reader& reader, console& to);

// Which deliveries are wanted: by actor, sender, type, text in the message, id, cause and how they ended.
//
// `*` stands for any letters in names, capitals count; several of one kind are joined by "or", kinds by "and".
// Errors: none; an outcome that is mistyped is refused by the command line. Thread: one at a time.
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
