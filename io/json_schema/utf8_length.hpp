// How long a text is in the eyes of a schema, and of people: in characters and not in bytes. Of a text that is UTF-8.
// Thread: pure. Source: RFC 3629; JSON Schema draft-07, minLength and maxLength.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace godwit::io::schemas {

// Counts the bytes that do not continue a character.
[[nodiscard]] inline std::size_t utf8_length(std::string_view text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char each) { return (static_cast<unsigned char>(each) & 0xC0U) != 0x80U; }));
}

} // namespace godwit::io::schemas
