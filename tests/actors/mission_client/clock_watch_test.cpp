#include "actors/mission_client/clock_watch.hpp"

#include <gtest/gtest.h>

namespace clock_watch_test {

using namespace godwit::mission_client;

TEST(mission_client_clock_watch, a_clock_that_runs_is_no_jump) {
  clock_watch watch;
  for (std::int64_t i = 0; i < 1'000; ++i)
    EXPECT_FALSE(watch.jump({i * second_ns, 1'800'000'000 * second_ns + i * second_ns}));
}

TEST(mission_client_clock_watch, a_clock_that_was_set_is_noticed_once_in_both_directions) {
  clock_watch watch;
  EXPECT_FALSE(watch.jump({0, 0}));
  EXPECT_EQ(watch.jump({second_ns, 1'800'000'000 * second_ns}), 1'799'999'999 * second_ns);
  EXPECT_FALSE(watch.jump({2 * second_ns, 1'800'000'001 * second_ns}));
  EXPECT_EQ(watch.jump({3 * second_ns, 1'799'999'002 * second_ns}), -1'000 * second_ns);
}

TEST(mission_client_clock_watch, small_steps_are_noticed_when_they_have_added_up) {
  clock_watch watch;
  EXPECT_FALSE(watch.jump({0, 0}));
  EXPECT_FALSE(watch.jump({0, second_ns * 3 / 4}));
  EXPECT_TRUE(watch.jump({0, second_ns * 6 / 4}));
}

} // namespace clock_watch_test
