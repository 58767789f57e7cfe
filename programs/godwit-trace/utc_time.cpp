#include "programs/godwit-trace/utc_time.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>

#include "io/fields/utc_seconds.hpp"

namespace godwit::trace_tool {

namespace {

constexpr std::uint64_t us_per_s = 1'000'000;
constexpr std::uint64_t year_10000_us = 253'402'300'800 * us_per_s;
constexpr std::size_t fraction_digits = 6;

void append_digits(std::string& out, std::uint64_t value, std::size_t width) {
  std::array<char, 20> digits;
  const auto* const end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  const auto count = static_cast<std::size_t>(end - digits.data());
  out.append(width - std::min(width, count), '0').append(digits.data(), count);
}

} // namespace

void append_utc(std::string& out, std::uint64_t time_us) {
  if (time_us >= year_10000_us) {
    append_digits(out, time_us, 0);
    out += "us";
    return;
  }
  out += io::utc_seconds_text(std::chrono::sys_seconds(std::chrono::seconds(time_us / us_per_s)));
  out += '.';
  append_digits(out, time_us % us_per_s, fraction_digits);
  out += 'Z';
}

void append_seconds(std::string& out, std::int64_t since_us) {
  const auto size_us = since_us < 0 ? 0 - static_cast<std::uint64_t>(since_us) : static_cast<std::uint64_t>(since_us);
  if (since_us < 0)
    out += '-';
  append_digits(out, size_us / us_per_s, 0);
  out += '.';
  append_digits(out, size_us % us_per_s, fraction_digits);
}

std::optional<std::uint64_t> parse_utc(std::string_view text) {
  if (text.ends_with('Z'))
    text.remove_suffix(1);
  const auto whole = io::parse_utc_seconds(text.substr(0, io::utc_seconds_bytes));
  if (!whole || whole->time_since_epoch().count() < 0)
    return std::nullopt;
  const auto us = io::parse_decimals(text.substr(io::utc_seconds_bytes), fraction_digits);
  if (!us)
    return std::nullopt;
  return static_cast<std::uint64_t>(whole->time_since_epoch().count()) * us_per_s + static_cast<std::uint64_t>(*us);
}

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
