#include "programs/godwitd/durations.hpp"

#include <gtest/gtest.h>

namespace durations_test {

using godwit::daemon::duration_text;

constexpr std::int64_t second_ns = 1'000'000'000;

TEST(durations, are_told_in_the_unit_that_people_would_use) {
  EXPECT_EQ(duration_text(-5), "0 s");
  EXPECT_EQ(duration_text(450'000'000), "0.4 s");
  EXPECT_EQ(duration_text(12 * second_ns), "12 s");
  EXPECT_EQ(duration_text(119 * second_ns), "119 s");
  EXPECT_EQ(duration_text(180 * second_ns), "3 min");
  EXPECT_EQ(duration_text(5 * 3600 * second_ns + 1200 * second_ns), "5 h 20 min");
  EXPECT_EQ(duration_text(3600 * second_ns), "1 h");
  EXPECT_EQ(duration_text(72 * 3600 * second_ns), "3 days");
}

} // namespace durations_test
