// Holds what a simulation recorded (runtime/simulation/simulation.hpp) against the promises in invariants/.
// Thread: one at a time.
#pragma once

#include <charconv>
#include <string>
#include <string_view>
#include <vector>

#include "invariants/checker.hpp"

namespace godwit::tests {

class recorded_promises {
public:
  // All that one process recorded; the next call is about the next process.
  void take(const std::vector<std::string>& lines) {
    ++run_;
    for (const auto& each : lines)
      take_line(each);
  }

  // What is not kept, as sentences; empty when all is.
  [[nodiscard]] std::string broken() const {
    std::string result;
    for (const auto& each : checker_.judge())
      if (each.how == invariants::verdict::violated)
        result += std::string(each.which->name) + ": " + each.findings.front().what + '\n';
    return result;
  }

private:
  // "1200 ns counter/2 <- outside #17 because #3 add{"by":1} crashed"
  void take_line(std::string_view line) {
    const auto until = [&line](std::string_view mark) {
      const auto end = line.find(mark);
      const auto result = line.substr(0, end);
      line.remove_prefix(end == std::string_view::npos ? line.size() : end + mark.size());
      return result;
    };
    const auto number = [](std::string_view text) {
      std::int64_t result = 0;
      std::from_chars(text.data(), text.data() + text.size(), result);
      return result;
    };
    runtime::delivery each;
    each.run = run_;
    each.began_ns = number(until(" ns "));
    each.actor = names_.number(until("/"));
    each.incarnation = static_cast<std::uint32_t>(number(until(" <- ")));
    each.sender = names_.number(until(" #"));
    each.id = static_cast<std::uint64_t>(number(until(" because #")));
    each.cause = static_cast<std::uint64_t>(number(until(" ")));
    const auto how = line.substr(line.rfind(' ') + 1);
    for (const auto& [value, name] : enum_names(runtime::outcome{}))
      if (name == how)
        each.how = value;
    const auto body = line.find('{');
    each.type = names_.number(line.substr(0, body));
    each.body = line.substr(body, line.rfind(' ') - body);
    checker_.take(each, names_);
  }

  std::uint64_t run_ = 0;
  runtime::name_table names_;
  invariants::checker checker_;
};

} // namespace godwit::tests
