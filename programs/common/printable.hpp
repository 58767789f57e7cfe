// Text from outside, fit for a terminal and a log: what has an effect instead of a look is shown as an escape, so that
// nobody's words move the cursor, ring, turn the line around, or look like a line of ours.
//
// Escaped are C0 and DEL, C1 in UTF-8, line and paragraph separators, and the characters of Unicode that are not seen:
// those that turn the direction of writing, join, or take no room: "\\x1b", "\\xc2\\x9b", "\\xe2\\x80\\xae". Tabs stay.
// Text that is escaped stays as it is when it is escaped again. Thread: pure. Source: Unicode 15, Cf; UAX 9.
#pragma once

#include <string>
#include <string_view>

namespace godwit::programs {

// Of several lines: AFTER_LINE_END stands behind each line end, so that what follows is seen to belong to it.
[[nodiscard]] std::string printable(std::string_view text, std::string_view after_line_end = "    ");

// Of one line, such as a name or a reason: line ends are escaped, too.
[[nodiscard]] std::string one_line(std::string_view text);

} // namespace godwit::programs
