// The part of RFC 3339 that all our times share, "2026-05-04T10:15:30", and the decimals after it.
//
// Always UTC; leap seconds are not known. Errors: no value for what is no time. Thread: pure.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace godwit::io {

inline constexpr std::size_t utc_seconds_bytes = 19;

// Of the years 0 to 9999.
[[nodiscard]] std::string utc_seconds_text(std::chrono::sys_seconds time);
[[nodiscard]] std::optional<std::chrono::sys_seconds> parse_utc_seconds(std::string_view text);

// ".25" as 250 with DIGITS 3, of which there may be no more; none: 0.
[[nodiscard]] std::optional<std::int64_t> parse_decimals(std::string_view text, std::size_t digits);

} // namespace godwit::io
