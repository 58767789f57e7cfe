// Points in time as text: 2026-07-01T12:34:56.123456Z, as in RFC 3339 and always UTC.
//
// Times are microseconds since 1970. Errors: none; text that is not a time gives nothing. Thread: pure.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <tl/expected.hpp>

namespace godwit::trace_tool {

// What comes after the year 9999, in a log that is damaged, is written as a number: 18446744073709551615us.
void append_utc(std::string& out, std::uint64_t time_us);

// SINCE_US and six decimals, in seconds: 12.345678. Negative for what stands before the beginning.
void append_seconds(std::string& out, std::int64_t since_us);

// The same form; the fraction (one to six digits) and the Z may be missing.
[[nodiscard]] std::optional<std::uint64_t> parse_utc(std::string_view text);

// The part of a log that is wanted: from a point in time on (included) to another (not included), so that ranges that
// touch give each message once.
//
// A point is seconds since the first record of the log, such as 12.5, or UTC as in utc_time.hpp. Errors: a sentence.
// Thread: values.
struct time_mark {
  bool is_since_begin = false; // of the log; else since 1970
  std::uint64_t time_us = 0;
  bool operator==(const time_mark&) const = default;
};

[[nodiscard]] tl::expected<time_mark, std::string> parse_time_mark(std::string_view text);

struct time_range {
  std::optional<time_mark> from;
  std::optional<time_mark> to;

  [[nodiscard]] bool contains(std::uint64_t time_us, std::uint64_t begin_us) const;
};

} // namespace godwit::trace_tool
