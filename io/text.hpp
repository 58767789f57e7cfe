// Parts of texts. Thread: pure.
#pragma once

#include <string_view>

namespace godwit::io {

// TEXT without the BLANKS at its beginning and its end.
[[nodiscard]] inline std::string_view trimmed(std::string_view text, std::string_view blanks = " ") {
  const auto first = text.find_first_not_of(blanks);
  return first == std::string_view::npos ? "" : text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

} // namespace godwit::io
