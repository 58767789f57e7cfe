// Takes a token out of what a service sent: one that echoes the request must not bring it into a log or onto a disk.
//
// Also in the form in which JSON may write it, with a slash escaped. Thread: pure.
#pragma once

#include <string>
#include <string_view>

namespace godwit::io::http {

// A shorter one would be found in any text.
inline constexpr std::size_t min_redacted_bytes = 6;
inline constexpr std::string_view redacted = "(token)";

void redact(std::string& text, std::string_view token);

} // namespace godwit::io::http
