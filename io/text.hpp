// Parts of texts. Thread: pure.
#pragma once

#include <charconv>
#include <string_view>
#include <system_error>

namespace godwit::io {

// TEXT without the BLANKS at its beginning and its end.
[[nodiscard]] inline std::string_view trimmed(std::string_view text, std::string_view blanks = " ") {
  const auto first = text.find_first_not_of(blanks);
  return first == std::string_view::npos ? "" : text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

// All of TEXT. False: it is no number, or not one of TO's kind.
template <class Number>
[[nodiscard]] bool read_number(std::string_view text, Number& to) {
  const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), to);
  return failed == std::errc() && end == text.data() + text.size();
}

} // namespace godwit::io
