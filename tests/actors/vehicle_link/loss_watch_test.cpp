#include "actors/vehicle_link/loss_watch.hpp"
#include "tests/support/time_units.hpp"

#include <gtest/gtest.h>

namespace godwit::vehicle_link {
namespace loss_watch_test {

using godwit::tests::s;

TEST(loss_watch, a_tenth_that_is_lost_over_ten_seconds_is_bad_and_is_forgotten_when_it_is_better) {
  loss_watch watch;
  watch.look(1'000, 0, 10 * s);
  EXPECT_FALSE(watch.is_due(19 * s));
  EXPECT_TRUE(watch.is_due(20 * s));
  watch.look(1'900, 100, 20 * s);
  EXPECT_TRUE(watch.is_bad());
  EXPECT_EQ(watch.sentence().find("10 %"), 0U);
  watch.look(2'900, 101, 30 * s);
  EXPECT_FALSE(watch.is_bad());
}

TEST(loss_watch, a_few_frames_and_what_was_lost_before_it_looked_say_nothing) {
  loss_watch watch;
  watch.look(10, 1'000, 10 * s);
  EXPECT_FALSE(watch.is_bad());
  watch.look(20, 1'019, 20 * s);
  EXPECT_FALSE(watch.is_bad());
}

TEST(loss_watch, counts_that_begin_anew_are_no_loss) {
  loss_watch watch;
  watch.look(1'000, 500, 10 * s);
  watch.look(100, 90, 20 * s);
  EXPECT_FALSE(watch.is_bad());
}

} // namespace loss_watch_test
} // namespace godwit::vehicle_link
