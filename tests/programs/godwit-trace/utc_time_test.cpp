#include "programs/godwit-trace/utc_time.hpp"

#include <limits>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace godwit::trace_tool {
namespace utc_time_test {

std::string utc(std::uint64_t time_us) {
  std::string out;
  append_utc(out, time_us);
  return out;
}

std::string seconds(std::int64_t since_us) {
  std::string out;
  append_seconds(out, since_us);
  return out;
}

TEST(utc_time, times_are_written_with_all_their_digits) {
  EXPECT_EQ(utc(0), "1970-01-01T00:00:00.000000Z");
  EXPECT_EQ(utc(1'781'000'000'123'456), "2026-06-09T10:13:20.123456Z");
  EXPECT_EQ(utc(253'402'300'799'999'999), "9999-12-31T23:59:59.999999Z");
}

TEST(utc_time, what_no_calendar_has_is_written_as_a_number) {
  EXPECT_EQ(utc(253'402'300'800'000'000), "253402300800000000us");
  EXPECT_EQ(utc(std::numeric_limits<std::uint64_t>::max()), "18446744073709551615us");
}

TEST(utc_time, seconds_have_six_decimals_and_may_be_negative) {
  EXPECT_EQ(seconds(0), "0.000000");
  EXPECT_EQ(seconds(12'345'678), "12.345678");
  EXPECT_EQ(seconds(-1'500'000), "-1.500000");
  EXPECT_EQ(seconds(std::numeric_limits<std::int64_t>::min()), "-9223372036854.775808");
}

TEST(utc_time, fraction_and_z_may_be_missing) {
  const std::uint64_t second_us = 1'781'000'000'000'000;
  EXPECT_EQ(parse_utc("2026-06-09T10:13:20"), second_us);
  EXPECT_EQ(parse_utc("2026-06-09T10:13:20Z"), second_us);
  EXPECT_EQ(parse_utc("2026-06-09T10:13:20.5Z"), second_us + 500'000);
  EXPECT_EQ(parse_utc("2026-06-09T10:13:20.000001"), second_us + 1);
}

TEST(utc_time, what_is_not_a_time_gives_nothing) {
  for (const char* each : {"", "2026-06-09", "2026-06-09T10:13", "2026-06-09 10:13:20", "2026-13-09T10:13:20",
                           "2026-02-30T10:13:20", "2026-06-09T24:00:00", "2026-06-09T10:60:00", "2026-06-09T10:13:61",
                           "2026-06-09T10:13:20.", "2026-06-09T10:13:20.1234567", "2026-06-09T10:13:20+02:00",
                           "1969-12-31T23:59:59", "2026-06-09T10:13:20.5ZZ", "+026-06-09T10:13:20"})
    EXPECT_EQ(parse_utc(each), std::nullopt) << each;
}

RC_GTEST_PROP(utc_time, every_time_reads_back_as_itself, ()) {
  const auto time_us = *rc::gen::inRange<std::uint64_t>(0, 253'402'300'800'000'000);
  RC_ASSERT(parse_utc(utc(time_us)) == time_us);
}

} // namespace utc_time_test
} // namespace godwit::trace_tool
