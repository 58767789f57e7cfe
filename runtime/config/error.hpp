// What is wrong with a configuration, as a value for the caller and sentences for people.
//
// Everything that is wrong is listed at once: who has five mistakes in a file wants to start the program twice, not six
// times. Thread: plain value, any thread.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace godwit::runtime {

enum class config_errc {
  unreadable, // the file can not be opened or read
  too_large,  // more than max_config_bytes
  syntax,     // not JSON; line and column tell where
  invalid,    // JSON, but not what the schema allows
};

struct config_problem {
  std::string path;    // where in the document: `trace.total_mib`, `links[2].port`; empty for the whole document
  std::string what;    // what is there: "is 5"
  std::string allowed; // what may be there: "an integer from 16 to 65536"; empty when `what` says it all

  friend bool operator==(const config_problem&, const config_problem&) = default;
};

struct config_error {
  config_errc code{};
  std::string source;                   // the file, or a word for where the text came from
  std::size_t line = 0;                 // from 1; 0 when there is no single place
  std::size_t column = 0;               // from 1, in bytes; 0 when there is no single place
  std::vector<config_problem> problems; // never empty
  std::size_t omitted = 0;              // problems beyond max_config_problems

  // "godwit.json: trace.total_mib is 5; allowed: an integer from 16 to 65536", one line for each problem.
  [[nodiscard]] std::string message() const;
};

} // namespace godwit::runtime
