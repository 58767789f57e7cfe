#include "io/fields/utc_seconds.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace godwit::io {
namespace utc_seconds_test {

using namespace std::chrono;

TEST(utc_seconds, the_first_and_the_last_year_have_four_digits) {
  EXPECT_EQ(utc_seconds_text(sys_seconds(seconds(253'402'300'799))), "9999-12-31T23:59:59");
  EXPECT_EQ(utc_seconds_text(sys_days(year(7) / 1 / 2)), "0007-01-02T00:00:00");
}

TEST(utc_seconds, another_form_or_a_day_that_does_not_exist_is_no_time) {
  for (const auto* text : {"", "2026-05-04T10:15:30Z", "2026-05-04 10:15:30", "2026-02-30T10:15:30",
                           "2026-05-04T24:00:00", "2026-05-04T10:60:00", "2026-05-04T10:15:60", "+026-05-04T10:15:30"})
    EXPECT_EQ(parse_utc_seconds(text), std::nullopt) << text;
}

TEST(utc_seconds, decimals_count_from_the_left) {
  EXPECT_EQ(parse_decimals("", 3), 0);
  EXPECT_EQ(parse_decimals(".25", 3), 250);
  EXPECT_EQ(parse_decimals(".025", 3), 25);
  for (const auto* text : {".", ".1234", "25", ".2x", ".-1"})
    EXPECT_EQ(parse_decimals(text, 3), std::nullopt) << text;
}

RC_GTEST_PROP(utc_seconds_property, a_time_reads_back_as_itself, ()) {
  const sys_seconds time{seconds(*rc::gen::inRange<std::int64_t>(-62'167'219'200, 253'402'300'800))};
  RC_ASSERT(parse_utc_seconds(utc_seconds_text(time)) == time);
}

} // namespace utc_seconds_test
} // namespace godwit::io
