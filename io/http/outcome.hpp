// What an answer means for trying again.
//
// A status is no error of the client: the service was there and spoke. Who retries asks here.
//
// Thread: any, pure. Source: RFC 9110, 15 (status codes) and 10.2.3 (Retry-After); RFC 6585, 4 (429).
#pragma once

#include <chrono>
#include <optional>

#include "io/http/http_date.hpp"
#include "io/http/message.hpp"

namespace godwit::io::http {

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
