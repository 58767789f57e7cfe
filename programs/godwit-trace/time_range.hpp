// The part of a log that is wanted: from a point in time on (included) to another (not included), so that ranges that
// touch give each message once.
//
// A point is seconds since the first record of the log, such as 12.5, or UTC as in utc_time.hpp. Errors: a sentence.
// Thread: values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <tl/expected.hpp>

namespace godwit::trace_tool {

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
