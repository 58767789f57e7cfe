#include "actors/domain/mission/utc_text.hpp"

#include <array>
#include <chrono>
#include <cstdio>

#include "io/fields/utc_seconds.hpp"

namespace godwit::mission {

namespace {

using namespace std::chrono;

constexpr year first_year{1678};
constexpr year last_year{2261};
constexpr std::size_t decimals = 9;

} // namespace

std::string utc_text(std::int64_t time_ns) {
  const sys_time<nanoseconds> time{nanoseconds(time_ns)};
  const auto whole = floor<seconds>(time);
  auto result = io::utc_seconds_text(whole);
  if (const auto rest = (time - whole).count(); rest != 0) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), ".%09lld", static_cast<long long>(rest));
    result += text.data();
    result.erase(result.find_last_not_of('0') + 1);
  }
  return result + 'Z';
}

std::optional<std::int64_t> time_of_utc_text(std::string_view text) {
  if (!text.ends_with('Z'))
    return std::nullopt;
  text.remove_suffix(1);
  const auto whole = io::parse_utc_seconds(text.substr(0, io::utc_seconds_bytes));
  if (!whole)
    return std::nullopt;
  const auto fraction = io::parse_decimals(text.substr(io::utc_seconds_bytes), decimals);
  const auto year = year_month_day(floor<days>(*whole)).year();
  if (!fraction || year < first_year || year > last_year)
    return std::nullopt;
  return nanoseconds(whole->time_since_epoch()).count() + *fraction;
}

} // namespace godwit::mission
