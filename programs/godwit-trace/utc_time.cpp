#include "programs/godwit-trace/utc_time.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>

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

// Takes a number of exactly WIDTH digits, and BEHIND, off TEXT.
std::optional<unsigned> take_digits(std::string_view& text, std::size_t width, std::string_view behind = {}) {
  unsigned value = 0;
  const auto part = text.substr(0, width);
  const auto is_digit = [](char each) { return each >= '0' && each <= '9'; };
  if (part.size() != width || !std::ranges::all_of(part, is_digit) || !text.substr(width).starts_with(behind))
    return std::nullopt;
  std::from_chars(part.data(), part.data() + part.size(), value);
  text.remove_prefix(width + behind.size());
  return value;
}

// Microseconds of ".123"; takes all of TEXT.
std::optional<std::uint64_t> fraction_us(std::string_view text) {
  if (text.empty())
    return 0;
  text.remove_prefix(text.starts_with('.') ? 1 : 0);
  const std::size_t count = text.size();
  if (count == 0 || count > fraction_digits)
    return std::nullopt;
  auto value = take_digits(text, count);
  for (std::size_t i = count; value && i < fraction_digits; ++i)
    *value *= 10;
  return value;
}

} // namespace

void append_utc(std::string& out, std::uint64_t time_us) {
  if (time_us >= year_10000_us) {
    append_digits(out, time_us, 0);
    out += "us";
    return;
  }
  using namespace std::chrono;
  const sys_seconds time{seconds(time_us / us_per_s)};
  const auto day = floor<days>(time);
  const year_month_day date(day);
  const hh_mm_ss clock(time - day);
  append_digits(out, static_cast<unsigned>(static_cast<int>(date.year())), 4);
  out += '-';
  append_digits(out, static_cast<unsigned>(date.month()), 2);
  out += '-';
  append_digits(out, static_cast<unsigned>(date.day()), 2);
  out += 'T';
  append_digits(out, static_cast<std::uint64_t>(clock.hours().count()), 2);
  out += ':';
  append_digits(out, static_cast<std::uint64_t>(clock.minutes().count()), 2);
  out += ':';
  append_digits(out, static_cast<std::uint64_t>(clock.seconds().count()), 2);
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
  const auto year = take_digits(text, 4, "-");
  const auto month = take_digits(text, 2, "-");
  const auto day = take_digits(text, 2, "T");
  const auto hour = take_digits(text, 2, ":");
  const auto minute = take_digits(text, 2, ":");
  const auto second = take_digits(text, 2);
  if (!year || !month || !day || !hour || !minute || !second || !(text.empty() || text.front() == '.'))
    return std::nullopt;
  const auto us = fraction_us(text);
  const std::chrono::year_month_day date{std::chrono::year(static_cast<int>(*year)), std::chrono::month(*month),
                                         std::chrono::day(*day)};
  if (!us || !date.ok() || *year < 1970 || *hour > 23 || *minute > 59 || *second > 59)
    return std::nullopt;
  const auto days = static_cast<std::uint64_t>(std::chrono::sys_days(date).time_since_epoch().count());
  return (((days * 24 + *hour) * 60 + *minute) * 60 + *second) * us_per_s + *us;
}

} // namespace godwit::trace_tool
