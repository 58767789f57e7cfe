// How times, durations, deliveries and losses look as text and as JSON, the same in all commands about the trace.
//
// Times are UTC with nanoseconds, "2026-11-23T08:03:49.123456789Z". Errors: none. Thread: pure.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/trace/reading/delivery.hpp"

namespace godwit::trace_tool {

void append_utc_ns(std::string& out, std::int64_t at_ns);
[[nodiscard]] std::string utc_ns(std::int64_t at_ns);
// "850 ns", "6.7 us", "12.3 ms", "4.56 s": three digits, and a unit that fits.
[[nodiscard]] std::string duration_text(std::int64_t duration_ns);

// Text that came from outside, fit for a terminal: control characters are escaped.
void append_printable(std::string& out, std::string_view text);

// Another member of an object in JSON: ,"NAME":"TEXT".
void append_member(std::string& out, std::string_view name, std::string_view text);

// What marks a part of a line on a terminal; nothing elsewhere, or where NO_COLOR is set (https://no-color.org).
class paint {
public:
  explicit paint(bool is_terminal);
  [[nodiscard]] const char* actor() const { return is_on_ ? "\x1b[36m" : ""; }
  [[nodiscard]] const char* type() const { return is_on_ ? "\x1b[1m" : ""; }
  [[nodiscard]] const char* bad() const { return is_on_ ? "\x1b[31m" : ""; }
  [[nodiscard]] const char* good() const { return is_on_ ? "\x1b[32m" : ""; }
  [[nodiscard]] const char* faint() const { return is_on_ ? "\x1b[2m" : ""; }
  [[nodiscard]] const char* end() const { return is_on_ ? "\x1b[0m" : ""; }

private:
  bool is_on_;
};

// One line: time, actor/incarnation, sender, type, id, cause, time in the handler, how it ended if not well, message.
void append_line(std::string& out, const runtime::delivery& each, const runtime::name_table& names,
                 const paint& colours);
// The same as one object, without a line's end.
void append_json_line(std::string& out, const runtime::delivery& each, const runtime::name_table& names);

[[nodiscard]] std::string loss_sentence(const runtime::loss& each);
void append_loss_json(std::string& out, const runtime::loss& each);

// A table of text: each column as wide as what stands in it, numbers to the right. Thread: a value.
class text_table {
public:
  struct column {
    std::string title;
    bool is_number = true;
  };
  explicit text_table(std::vector<column> columns) : columns_(std::move(columns)) {}

  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
  void append_to(std::string& out) const;

private:
  std::vector<column> columns_;
  std::vector<std::vector<std::string>> rows_;
};

} // namespace godwit::trace_tool
