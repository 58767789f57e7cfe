// Text from outside, fit for a terminal and a log: control characters are shown as escapes, so that nobody's words move
// the cursor, ring, or look like a line of ours.
//
// Escaped are C0 (but for line ends, which the caller sees to), DEL, and C1 in UTF-8: "\\x1b", "\\xc2\\x9b". Tabs stay.
// Thread: pure.
#pragma once

#include <string>
#include <string_view>

namespace godwit::programs {

// AFTER_LINE_END stands behind each line end, so that what follows is seen to belong to it.
[[nodiscard]] std::string printable(std::string_view text, std::string_view after_line_end = "    ");

} // namespace godwit::programs
