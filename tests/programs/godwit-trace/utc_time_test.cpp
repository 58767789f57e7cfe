#include <limits>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "programs/godwit-trace/utc_time.hpp"

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

namespace time_range_test {

TEST(time_range, a_mark_is_seconds_or_utc) {
  EXPECT_EQ(parse_time_mark("12.5"), (time_mark{true, 12'500'000}));
  EXPECT_EQ(parse_time_mark("0"), (time_mark{true, 0}));
  EXPECT_EQ(parse_time_mark("2026-06-09T10:13:20Z"), (time_mark{false, 1'781'000'000'000'000}));
  for (const char* each : {"", "soon", "-1", "1s", "nan", "inf", "1e300", "2026-06-09"})
    EXPECT_FALSE(parse_time_mark(each)) << each;
  EXPECT_EQ(parse_time_mark("soon").error(), "\"soon\" is neither seconds since the beginning of the log, such as "
                                             "12.5, nor UTC such as 2026-07-01T12:34:56Z");
}

TEST(time_range, the_first_point_is_in_it_and_the_last_is_not) {
  const time_range range{time_mark{true, 10}, time_mark{false, 1'020}};
  constexpr std::uint64_t begin_us = 1'000;
  EXPECT_FALSE(range.contains(1'009, begin_us));
  EXPECT_TRUE(range.contains(1'010, begin_us));
  EXPECT_TRUE(range.contains(1'019, begin_us));
  EXPECT_FALSE(range.contains(1'020, begin_us));
}

TEST(time_range, without_marks_it_holds_everything) {
  EXPECT_TRUE(time_range{}.contains(0, 5));
  EXPECT_TRUE(time_range{}.contains(~std::uint64_t{0}, 5));
}

} // namespace time_range_test

} // namespace godwit::trace_tool
