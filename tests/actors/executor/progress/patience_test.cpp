#include "actors/executor/progress/patience.hpp"

#include <gtest/gtest.h>

namespace godwit::executor::progress {
namespace patience_test {

TEST(patience, a_span_is_over_when_it_has_passed) {
  EXPECT_FALSE(is_over(100, 100, 10));
  EXPECT_FALSE(is_over(100, 109, 10));
  EXPECT_TRUE(is_over(100, 110, 10));
}

TEST(patience, a_clock_that_was_set_back_is_not_waited_for) { EXPECT_TRUE(is_over(100, 99, 10)); }

TEST(patience, px4_repeats_a_reached_and_swaps_messages_within_these_times) {
  EXPECT_GE(settling_ns, 1'650'000'000); // a period of a second, and 0.65 s between messages of one moment
  EXPECT_GE(reached_late_ns, 650'000'000);
}

} // namespace patience_test
} // namespace godwit::executor::progress
