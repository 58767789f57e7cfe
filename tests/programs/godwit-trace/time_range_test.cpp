#include "programs/godwit-trace/time_range.hpp"

#include <gtest/gtest.h>

namespace godwit::trace_tool {
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
