#include "io/http/http_date.hpp"

#include <gtest/gtest.h>

namespace godwit::io::http {
namespace http_date_test {

using namespace std::chrono_literals;

constexpr wall_time now = std::chrono::sys_days(2026y / 11 / 21) + 14h;
constexpr wall_time example = std::chrono::sys_days(1994y / 11 / 6) + 8h + 49min + 37s;

TEST(http_date, is_read_in_all_three_forms_of_the_standard) {
  EXPECT_EQ(parse_http_date("Sun, 06 Nov 1994 08:49:37 GMT", now), example);
  EXPECT_EQ(parse_http_date("Sunday, 06-Nov-94 08:49:37 GMT", now), example);
  EXPECT_EQ(parse_http_date("Sun Nov  6 08:49:37 1994", now), example);
}

TEST(http_date, with_two_digits_is_at_most_50_years_ahead) {
  EXPECT_EQ(parse_http_date("Sunday, 06-Nov-76 08:49:37 GMT", now),
            std::chrono::sys_days(2076y / 11 / 6) + 8h + 49min + 37s);
  EXPECT_EQ(parse_http_date("Sunday, 06-Nov-77 08:49:37 GMT", now),
            std::chrono::sys_days(1977y / 11 / 6) + 8h + 49min + 37s);
}

TEST(http_date, must_exist) {
  for (const auto* text :
       {"Sun, 31 Feb 2026 08:49:37 GMT", "Sun, 00 Nov 1994 08:49:37 GMT", "Sun, 06 Nov 1994 24:00:00 GMT",
        "Sun, 06 Nov 1994 08:60:37 GMT", "Sun, 06 Nov 1994 08:49:61 GMT", "Sun, 29 Feb 2025 00:00:00 GMT"})
    EXPECT_FALSE(parse_http_date(text, now)) << text;
  EXPECT_TRUE(parse_http_date("Thu, 29 Feb 2024 00:00:00 GMT", now));
  EXPECT_TRUE(parse_http_date("Sat, 31 Dec 2016 23:59:60 GMT", now)); // a leap second
}

TEST(http_date, of_any_other_form_is_none) {
  for (const auto* text :
       {"", "120", "Sun, 06 Nov 1994 08:49:37", "Sun, 06 Nov 1994 08:49:37 UTC", "Sun, 06 Nov 1994 08:49:37 GMT ",
        "sun, 06 nov 1994 08:49:37 gmt", "Sun, 6 Nov 1994 08:49:37 GMT", "1994-11-06T08:49:37Z"})
    EXPECT_FALSE(parse_http_date(text, now)) << text;
}

} // namespace http_date_test
} // namespace godwit::io::http
