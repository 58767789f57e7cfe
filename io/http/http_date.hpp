// The dates of HTTP headers.
//
// All three forms that a recipient must take: "Sun, 06 Nov 1994 08:49:37 GMT", which is the one in use, and the old
// "Sunday, 06-Nov-94 08:49:37 GMT" and "Sun Nov  6 08:49:37 1994". The day of the week is read and not judged; the date
// must exist. A year of two digits more than 50 years ahead of NOW is one of the last century.
//
// Errors: nothing, for what is no date. Thread: any, pure. Source: RFC 9110, 5.6.7.
#pragma once

#include <chrono>
#include <optional>
#include <string_view>

namespace godwit::io::http {

using wall_time = std::chrono::sys_seconds;

[[nodiscard]] std::optional<wall_time> parse_http_date(std::string_view text, wall_time now);

} // namespace godwit::io::http
