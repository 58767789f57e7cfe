// Times as the documents write them: RFC 3339 in UTC, such as 2026-05-04T10:15:30.25Z.
//
// Nanoseconds since 1970; from year 1678 to 2261, which is what 64 bits hold. Leap seconds are not known. Errors: no
// value for what is no time. Thread: pure.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace godwit::mission {

// As many decimals as it takes, up to nine.
[[nodiscard]] std::string utc_text(std::int64_t time_ns);

[[nodiscard]] std::optional<std::int64_t> time_of_utc_text(std::string_view text);

} // namespace godwit::mission
