// Text from outside, fit for a terminal and a log: control characters are shown as escapes, so that nobody's words move
// the cursor, ring, turn the direction of reading, or look like a line of ours.
//
// Escaped are C0 (but for line ends and tabs), DEL, C1 in UTF-8, the line and paragraph separators, and the characters
// that change the direction of text (Unicode, UAX 9): "\\x1b", "\\xc2\\x9b", "\\xe2\\x80\\xae". Thread: pure.
#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace godwit::programs {

// AFTER_LINE_END stands after each line end, so that what follows is seen to belong to it.
[[nodiscard]] std::string printable(std::string_view text, std::string_view after_line_end = "    ");
// Line ends are escaped, too.
[[nodiscard]] std::string one_line(std::string_view text);
// Each string of VALUE, at any depth, and each name, as printable() makes it.
[[nodiscard]] nlohmann::json printable_strings(const nlohmann::json& value);

} // namespace godwit::programs
