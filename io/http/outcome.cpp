#include "io/http/outcome.hpp"

#include <algorithm>
#include <array>
#include <charconv>

namespace godwit::io::http {

namespace {

using std::chrono::seconds;

std::optional<seconds> as_seconds(std::string_view text) {
  if (text.empty() || !std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; }))
    return std::nullopt;
  std::int64_t value = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
  return read.ec == std::errc() ? seconds(std::min<std::int64_t>(value, max_retry_after.count())) : max_retry_after;
}

} // namespace

outcome outcome_of(unsigned status) {
  if (status >= 200 && status <= 299)
    return outcome::success;
  return status == 408 || status == 429 || (status >= 500 && status <= 599) ? outcome::transient : outcome::permanent;
}

std::optional<seconds> retry_after(const response& answer, wall_time now) {
  const auto text = answer.find("Retry-After");
  if (const auto delay = as_seconds(text))
    return delay;
  const auto date = parse_http_date(text, now);
  if (!date)
    return std::nullopt;
  const auto said_at = parse_http_date(answer.find("Date"), now).value_or(now);
  return std::clamp<seconds>(*date - said_at, seconds(0), max_retry_after);
}

namespace {

namespace chrono = std::chrono;

constexpr std::array<std::string_view, 12> months{"Jan", "Feb", "Mar", "Apr", "May", "Jun",
                                                  "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};
constexpr std::array<std::string_view, 7> days{"Mon", "Tue", "Wed", "Thu", "Fri", "Sat", "Sun"};
constexpr std::array<std::string_view, 7> long_days{"Monday", "Tuesday",  "Wednesday", "Thursday",
                                                    "Friday", "Saturday", "Sunday"};

// Reads from the front. After the first thing that does not fit it takes nothing more, and is not ok.
class scanner {
public:
  explicit scanner(std::string_view text) : rest_(text) {}

  bool at_end() const { return ok_ && rest_.empty(); }

  void skip(std::string_view expected) {
    ok_ = ok_ && rest_.starts_with(expected);
    if (ok_)
      rest_.remove_prefix(expected.size());
  }

  int number(std::size_t digits) {
    ok_ = ok_ && rest_.size() >= digits &&
          std::ranges::all_of(rest_.substr(0, digits), [](char c) { return c >= '0' && c <= '9'; });
    if (!ok_)
      return 0;
    int value = 0;
    for (const char c : rest_.substr(0, digits))
      value = value * 10 + (c - '0');
    rest_.remove_prefix(digits);
    return value;
  }

  // "06", or " 6" as asctime(3) writes it.
  int padded_number() {
    if (!rest_.starts_with(' '))
      return number(2);
    skip(" ");
    return number(1);
  }

  template <std::size_t N>
  unsigned one_of(const std::array<std::string_view, N>& words) {
    const auto found = std::ranges::find_if(words, [&](std::string_view word) { return rest_.starts_with(word); });
    ok_ = ok_ && found != words.end();
    if (!ok_)
      return 0;
    rest_.remove_prefix(found->size());
    return static_cast<unsigned>(found - words.begin());
  }

private:
  std::string_view rest_;
  bool ok_ = true;
};

struct parts {
  int year = 0;
  unsigned month = 0; // 0 is January
  int day = 0;
  int hour = 0;
  int minute = 0;
  int second = 0;
};

void time_of_day(scanner& from, parts& to) {
  to.hour = from.number(2);
  from.skip(":");
  to.minute = from.number(2);
  from.skip(":");
  to.second = from.number(2);
}

std::optional<parts> in_use(std::string_view text) {
  scanner from(text);
  parts to;
  from.one_of(days);
  from.skip(", ");
  to.day = from.number(2);
  from.skip(" ");
  to.month = from.one_of(months);
  from.skip(" ");
  to.year = from.number(4);
  from.skip(" ");
  time_of_day(from, to);
  from.skip(" GMT");
  return from.at_end() ? std::optional(to) : std::nullopt;
}

int with_century(int two_digits, wall_time now) {
  const int this_year = static_cast<int>(chrono::year_month_day(chrono::floor<chrono::days>(now)).year());
  const int year = this_year - this_year % 100 + two_digits;
  return year > this_year + 50 ? year - 100 : year;
}

std::optional<parts> of_rfc_850(std::string_view text, wall_time now) {
  scanner from(text);
  parts to;
  from.one_of(long_days);
  from.skip(", ");
  to.day = from.number(2);
  from.skip("-");
  to.month = from.one_of(months);
  from.skip("-");
  to.year = with_century(from.number(2), now);
  from.skip(" ");
  time_of_day(from, to);
  from.skip(" GMT");
  return from.at_end() ? std::optional(to) : std::nullopt;
}

std::optional<parts> of_asctime(std::string_view text) {
  scanner from(text);
  parts to;
  from.one_of(days);
  from.skip(" ");
  to.month = from.one_of(months);
  from.skip(" ");
  to.day = from.padded_number();
  from.skip(" ");
  time_of_day(from, to);
  from.skip(" ");
  to.year = from.number(4);
  return from.at_end() ? std::optional(to) : std::nullopt;
}

std::optional<wall_time> assembled(const parts& of) {
  const chrono::year_month_day date{chrono::year(of.year), chrono::month(of.month + 1),
                                    chrono::day(static_cast<unsigned>(of.day))};
  if (!date.ok() || of.hour > 23 || of.minute > 59 || of.second > 60) // 60: a leap second
    return std::nullopt;
  return chrono::sys_days(date) + chrono::hours(of.hour) + chrono::minutes(of.minute) + chrono::seconds(of.second);
}

} // namespace

std::optional<wall_time> parse_http_date(std::string_view text, wall_time now) {
  auto read = in_use(text);
  if (!read)
    read = of_rfc_850(text, now);
  if (!read)
    read = of_asctime(text);
  return read ? assembled(*read) : std::nullopt;
}

} // namespace godwit::io::http
