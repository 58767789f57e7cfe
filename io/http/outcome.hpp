// What an answer means for trying again.
//
// A status is no error of the client: the service was there and spoke. Who retries asks here.
//
// Thread: any, pure. Source: RFC 9110, 15 (status codes) and 10.2.3 (Retry-After); RFC 6585, 4 (429).
#pragma once

#include <chrono>
#include <optional>
#include <string_view>

#include "io/http/message.hpp"

namespace godwit::io::http {

// The dates of HTTP headers.
//
// All three forms that a recipient must take: "Sun, 06 Nov 1994 08:49:37 GMT", which is the one in use, and the old
// "Sunday, 06-Nov-94 08:49:37 GMT" and "Sun Nov  6 08:49:37 1994". The day of the week is read and not judged; the date
// must exist. A year of two digits more than 50 years ahead of NOW is one of the last century.
//
// Errors: nothing, for what is no date. Thread: any, pure. Source: RFC 9110, 5.6.7.
using wall_time = std::chrono::sys_seconds;

[[nodiscard]] std::optional<wall_time> parse_http_date(std::string_view text, wall_time now);

// transient: the same request may be answered well later: 408, 429 and 5xx.
// permanent: asking again without a change is pointless: every other status that is not 2xx.
enum class outcome { success, transient, permanent };

[[nodiscard]] outcome outcome_of(unsigned status);

// A service that asks for more has been set up wrongly; who believed it would never come back.
inline constexpr std::chrono::seconds max_retry_after = std::chrono::hours(1);

// How long the service asks to wait, from NOW on: at least 0 and at most max_retry_after. None: it does not say, or
// says what can not be read. A date is taken relative to the Date of the same answer, where that can be read: the clock
// of a vehicle that has just started may be years off.
[[nodiscard]] std::optional<std::chrono::seconds> retry_after(const response& answer, wall_time now);

} // namespace godwit::io::http
