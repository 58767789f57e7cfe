// What is wrong with a document from outside: everything at once, up to a bound, each with its place.
//
// The sample is what a person needs to see what kind of answer this was; it is cut, and it is not for parsing. Thread:
// plain values.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/fields/field_table.hpp"
#include "io/json_schema/sentence_parts.hpp"

namespace godwit::mission {

inline constexpr std::size_t max_document_problems = 32; // more than anyone reads at once
inline constexpr std::size_t max_document_sample = 1024; // bytes of the body that are kept
inline constexpr std::size_t max_document_depth = 32;    // a survey plan of a ground station has 9 levels
inline constexpr std::size_t max_document_text = 16'000; // bytes: 4,000 characters, the longest of the contract
inline constexpr std::size_t max_document_key = 256;     // bytes of a property's name

enum class document_errc {
  too_large,     // more bytes than there may be
  syntax,        // not JSON, or not the text format that was expected
  wrong_form,    // JSON, but not what the schema or the format allows
  other_version, // of another major version of the contract
  broken_rule,   // the right form, but it contradicts itself
  lossy,         // could only be taken over in part; see the losses
};

GODWIT_ENUM_NAMES(document_errc, too_large, syntax, wrong_form, other_version, broken_rule, lossy);

struct document_problem {
  std::string pointer; // JSON pointer (RFC 6901), or "line 5" in a format of lines; empty: the whole document
  std::string what;    // what is there: "is 95"
  std::string allowed; // what may be there: "a number from -90 to 90"; empty when `what` says it all

  // "/items/3/at/latitude is 95; allowed: a number from -90 to 90"
  [[nodiscard]] std::string message() const;
  friend bool operator==(const document_problem&, const document_problem&) = default;
};

struct document_error {
  document_errc code{};
  std::vector<document_problem> problems{}; // never empty
  std::size_t omitted = 0;                  // problems beyond max_document_problems
  std::string sample{};                     // the beginning of the document

  // One line for each problem.
  [[nodiscard]] std::string message() const;
};

// ERROR with no more problems than there may be, and with the beginning of TEXT as sample.
[[nodiscard]] document_error bounded(document_error error, std::string_view text);

// POINTER with one more step, escaped as RFC 6901 says; a long key is cut.
[[nodiscard]] std::string pointer_to(std::string_view parent, std::string_view key);
[[nodiscard]] std::string pointer_to(std::string_view parent, std::size_t index);

using io::schemas::in_quotes;

} // namespace godwit::mission
