#include "actors/domain/mission/utc_text.hpp"

#include <array>
#include <charconv>
#include <chrono>
#include <cstdio>

namespace godwit::mission {

namespace {

using std::chrono::days;
using std::chrono::seconds;
using nanoseconds = std::chrono::duration<std::int64_t, std::nano>;

constexpr std::string_view form = "dddd-dd-ddTdd:dd:dd"; // d: a digit
constexpr int first_year = 1678;
constexpr int last_year = 2261;

bool has_form(std::string_view text) {
  if (text.size() <= form.size() || text.back() != 'Z')
    return false;
  for (std::size_t i = 0; i < form.size(); ++i)
    if (form[i] == 'd' ? text[i] < '0' || text[i] > '9' : text[i] != form[i])
      return false;
  return true;
}

int number(std::string_view text, std::size_t start, std::size_t size) {
  int result = 0;
  std::from_chars(text.data() + start, text.data() + start + size, result);
  return result;
}

// ".25" as nanoseconds; empty for none.
std::optional<std::int64_t> fraction_ns(std::string_view text) {
  if (text.empty())
    return 0;
  if (text.front() != '.' || text.size() < 2 || text.size() > 10)
    return std::nullopt;
  std::int64_t result = 0;
  for (std::size_t i = 1; i < 10; ++i) {
    const char digit = i < text.size() ? text[i] : '0';
    if (digit < '0' || digit > '9')
      return std::nullopt;
    result = result * 10 + (digit - '0');
  }
  return result;
}

} // namespace

std::string utc_text(std::int64_t time_ns) {
  const std::chrono::time_point<std::chrono::system_clock, nanoseconds> time{nanoseconds(time_ns)};
  const auto day = std::chrono::floor<days>(time);
  const std::chrono::year_month_day date(day);
  const std::chrono::hh_mm_ss<nanoseconds> clock(time - day);
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%04d-%02u-%02uT%02d:%02d:%02d", static_cast<int>(date.year()),
                static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                static_cast<int>(clock.hours().count()), static_cast<int>(clock.minutes().count()),
                static_cast<int>(clock.seconds().count()));
  std::string result(text.data());
  if (const auto rest = clock.subseconds().count(); rest != 0) {
    std::snprintf(text.data(), text.size(), ".%09lld", static_cast<long long>(rest));
    result += text.data();
    result.erase(result.find_last_not_of('0') + 1);
  }
  return result + 'Z';
}

std::optional<std::int64_t> time_of_utc_text(std::string_view text) {
  if (!has_form(text))
    return std::nullopt;
  const std::chrono::year_month_day date{std::chrono::year(number(text, 0, 4)),
                                         std::chrono::month(static_cast<unsigned>(number(text, 5, 2))),
                                         std::chrono::day(static_cast<unsigned>(number(text, 8, 2)))};
  const auto hour = number(text, 11, 2);
  const auto minute = number(text, 14, 2);
  const auto second = number(text, 17, 2);
  const auto fraction = fraction_ns(text.substr(form.size(), text.size() - form.size() - 1));
  if (!date.ok() || hour > 23 || minute > 59 || second > 59 || !fraction ||
      date.year() < std::chrono::year(first_year) || date.year() > std::chrono::year(last_year))
    return std::nullopt;
  const auto whole = std::chrono::sys_days(date).time_since_epoch() + seconds(hour * 3600 + minute * 60 + second);
  return nanoseconds(whole).count() + *fraction;
}

} // namespace godwit::mission
