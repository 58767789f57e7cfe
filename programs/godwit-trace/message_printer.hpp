// Prints messages in the form that was asked for, one a line. Thread: one at a time.
#pragma once

#include <bitset>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <tl/expected.hpp>

#include "io/mavlink/frame.hpp"
#include "programs/godwit-trace/name_filter.hpp"

namespace godwit::trace_tool {

enum class print_form { text, json };
enum class print_time { utc, since_begin };

class message_printer {
public:
  explicit message_printer(print_form form, print_time time = print_time::utc) : form_(form), time_(time) {}

  // What print_time::since_begin counts from.
  void begin_at(std::uint64_t time_us) { begin_us_ = time_us; }

  // TIME_US: since 1970 UTC.
  void append(std::string& out, std::uint64_t time_us, const io::mavlink::frame_view& frame) const;

private:
  void append_head(std::string& out, std::uint64_t time_us, io::mavlink::sender from) const;

  print_form form_;
  print_time time_;
  std::uint64_t begin_us_ = 0;
};

// Which messages are wanted: by name, and by who sent them. Thread: a value.
class message_filter {
public:
  message_filter() = default;
  // Empty lists: all systems, all components.
  message_filter(name_filter names, std::span<const std::uint8_t> systems, std::span<const std::uint8_t> components);

  [[nodiscard]] bool wants_sender(io::mavlink::sender who) const {
    return systems_.test(who.system) && components_.test(who.component);
  }
  [[nodiscard]] bool wants(const io::mavlink::frame_view& frame) const {
    return wants_sender(frame.from()) && names_.wants(frame.id());
  }

private:
  name_filter names_;
  std::bitset<256> systems_ = std::bitset<256>().set();
  std::bitset<256> components_ = std::bitset<256>().set();
};

// The options about what is printed and how, which several commands share.
//
// Errors: a sentence for people. Thread: values.
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
