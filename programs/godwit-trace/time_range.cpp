#include "programs/godwit-trace/time_range.hpp"

#include <charconv>
#include <cmath>

#include "programs/godwit-trace/utc_time.hpp"

namespace godwit::trace_tool {

tl::expected<time_mark, std::string> parse_time_mark(std::string_view text) {
  if (const auto utc_us = parse_utc(text))
    return time_mark{false, *utc_us};
  constexpr double max_s = 3.2e9; // a hundred years
  double seconds = 0;
  const auto [stopped, failure] = std::from_chars(text.data(), text.data() + text.size(), seconds);
  if (failure != std::errc{} || stopped != text.data() + text.size() || !(seconds >= 0 && seconds <= max_s))
    return tl::make_unexpected("\"" + std::string(text) +
                               "\" is neither seconds since the beginning of the log, such as 12.5, nor UTC such as "
                               "2026-07-01T12:34:56Z");
  return time_mark{true, static_cast<std::uint64_t>(std::llround(seconds * 1e6))};
}

bool time_range::contains(std::uint64_t time_us, std::uint64_t begin_us) const {
  const auto place = [&](const time_mark& mark) { return mark.time_us + (mark.is_since_begin ? begin_us : 0); };
  return (!from || time_us >= place(*from)) && (!to || time_us < place(*to));
}

} // namespace godwit::trace_tool
