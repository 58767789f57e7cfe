// Parts of sentences about a document: quoted text, the word that was probably meant, lengths of text. Thread: pure.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace godwit::io::schemas {

// "Did you mean ...?": the known word that is nearest to an unknown one.

// Nothing when no word is near: more than a third of the letters would have to change (two in a short word).
[[nodiscard]] std::optional<std::string> nearest_word(std::string_view word, const std::vector<std::string>& known);

// Somebody else's text in a sentence. Thread: pure.
inline constexpr std::size_t longest_quote = 60; // bytes of a text in a sentence; the rest is three dots

// In quotes, cut, always valid UTF-8 on one line.
[[nodiscard]] std::string in_quotes(std::string_view text);

// How long a text is in the eyes of a schema, and of people: in characters and not in bytes. Of a text that is UTF-8.
// Thread: pure. Source: RFC 3629; JSON Schema draft-07, minLength and maxLength.

// Counts the bytes that do not continue a character.
[[nodiscard]] inline std::size_t utf8_length(std::string_view text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char each) { return (static_cast<unsigned char>(each) & 0xC0U) != 0x80U; }));
}

} // namespace godwit::io::schemas
