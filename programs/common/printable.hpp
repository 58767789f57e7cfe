// Text from outside, fit for a terminal and a log: what has an effect instead of a look is shown as an escape, so that
// nobody's words move the cursor, ring, turn the line around, or look like a line of ours.
//
// Escaped are C0 and DEL, C1 in UTF-8, line and paragraph separators, and the characters of Unicode that are not seen:
// those that turn the direction of writing, join, or take no room: "\\x1b", "\\xc2\\x9b", "\\xe2\\x80\\xae". Tabs stay.
// Text that is escaped stays as it is when it is escaped again. Thread: pure. Source: Unicode 15, Cf; UAX 9.
#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace godwit::programs {

// Of several lines: AFTER_LINE_END stands after each line end, so that what follows is seen to belong to it.
[[nodiscard]] std::string printable(std::string_view text, std::string_view after_line_end = "    ");

// Of one line, such as a name or a reason: line ends are escaped, too.
[[nodiscard]] std::string one_line(std::string_view text);

// A configuration or a status as somebody else may see it.
//
// Left out are the values of names that mean a secret (token, password, secret, key, but not the names of files), and
// of addresses the user, the password and what stands after a question mark. Thread: pure.

[[nodiscard]] nlohmann::json without_secrets(nlohmann::json document);

// "https://ann:pw@host/x?token=1" -> "https://(left out)@host/x?(left out)"
[[nodiscard]] std::string address_without_secrets(const std::string& text);

} // namespace godwit::programs
