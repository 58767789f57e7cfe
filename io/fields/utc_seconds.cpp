#include "io/fields/utc_seconds.hpp"

#include <array>
#include <charconv>
#include <cstdio>

namespace godwit::io {
namespace {

using namespace std::chrono;

constexpr std::string_view form = "dddd-dd-ddTdd:dd:dd"; // d: a digit
static_assert(form.size() == utc_seconds_bytes);

bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool has_form(std::string_view text) {
  if (text.size() != form.size())
    return false;
  for (std::size_t i = 0; i < form.size(); ++i)
    if (form[i] == 'd' ? !is_digit(text[i]) : text[i] != form[i])
      return false;
  return true;
}

int number(std::string_view text, std::size_t start, std::size_t size) {
  int result = 0;
  std::from_chars(text.data() + start, text.data() + start + size, result);
  return result;
}

} // namespace

std::string utc_seconds_text(sys_seconds time) {
  const auto day = floor<days>(time);
  const year_month_day date(day);
  const hh_mm_ss clock(time - day);
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%04d-%02u-%02uT%02d:%02d:%02d", static_cast<int>(date.year()),
                static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                static_cast<int>(clock.hours().count()), static_cast<int>(clock.minutes().count()),
                static_cast<int>(clock.seconds().count()));
  return text.data();
}

std::optional<sys_seconds> parse_utc_seconds(std::string_view text) {
  if (!has_form(text))
    return std::nullopt;
  const year_month_day date{year(number(text, 0, 4)), month(static_cast<unsigned>(number(text, 5, 2))),
                            day(static_cast<unsigned>(number(text, 8, 2)))};
  const auto hour = number(text, 11, 2);
  const auto minute = number(text, 14, 2);
  const auto second = number(text, 17, 2);
  if (!date.ok() || hour > 23 || minute > 59 || second > 59)
    return std::nullopt;
  return sys_days(date) + hours(hour) + minutes(minute) + seconds(second);
}

std::optional<std::int64_t> parse_decimals(std::string_view text, std::size_t digits) {
  if (text.empty())
    return 0;
  if (text.front() != '.' || text.size() < 2 || text.size() > digits + 1)
    return std::nullopt;
  std::int64_t result = 0;
  for (std::size_t i = 1; i <= digits; ++i) {
    const char digit = i < text.size() ? text[i] : '0';
    if (!is_digit(digit))
      return std::nullopt;
    result = result * 10 + (digit - '0');
  }
  return result;
}

} // namespace godwit::io
