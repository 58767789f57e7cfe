// Where a text in UTF-8 may be cut. Thread: pure. Source: RFC 3629.
#pragma once

#include <cstddef>
#include <string_view>

namespace godwit::io {

// The size of the longest beginning of TEXT with at most MOST bytes that ends with a whole character.
[[nodiscard]] constexpr std::size_t whole_characters(std::string_view text, std::size_t most) {
  if (text.size() <= most)
    return text.size();
  while (most > 0 && (static_cast<unsigned char>(text[most]) & 0xC0U) == 0x80U)
    --most;
  return most;
}

} // namespace godwit::io
