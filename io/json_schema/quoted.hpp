// Somebody else's text in a sentence. Thread: pure.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace godwit::io::schemas {

inline constexpr std::size_t longest_quote = 60; // bytes of a text in a sentence; the rest is three dots

// In quotes, cut, always valid UTF-8 on one line.
[[nodiscard]] std::string in_quotes(std::string_view text);

} // namespace godwit::io::schemas
