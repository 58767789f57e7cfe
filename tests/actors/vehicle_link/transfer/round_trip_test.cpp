#include "actors/vehicle_link/transfer/round_trip.hpp"
#include "tests/support/time_units.hpp"

#include <gtest/gtest.h>

namespace godwit::vehicle_link::transfer {
namespace round_trip_test {

using godwit::tests::ms;

TEST(round_trip, begins_with_a_guess_below_the_period_in_which_px4_asks_again) {
  const round_trip line;
  EXPECT_FALSE(line.is_certain());
  EXPECT_EQ(line.timeout_ns(), round_trip::first_timeout_ns);
  EXPECT_LT(line.timeout_ns(), 260 * ms);
}

TEST(round_trip, an_even_line_has_a_timeout_little_above_its_round_trip) {
  round_trip line;
  for (int i = 0; i < 50; ++i)
    line.sample(30 * ms);
  EXPECT_EQ(line.smoothed_ns(), 30 * ms);
  EXPECT_EQ(line.timeout_ns(), 30 * ms + round_trip::min_margin_ns);
}

TEST(round_trip, an_uneven_line_gets_more_time) {
  round_trip line;
  for (int i = 0; i < 50; ++i)
    line.sample((i % 2 == 0 ? 30 : 60) * ms);
  EXPECT_GT(line.timeout_ns(), 60 * ms);
}

TEST(round_trip, a_late_answer_is_left_out_and_three_in_a_row_are_believed) {
  round_trip line;
  for (int i = 0; i < 20; ++i)
    line.sample(30 * ms);
  const auto before = line.timeout_ns();
  line.sample(290 * ms);
  line.sample(290 * ms);
  EXPECT_EQ(line.timeout_ns(), before);
  line.sample(290 * ms);
  EXPECT_GT(line.timeout_ns(), before);
}

TEST(round_trip, single_late_answers_between_others_never_count) {
  round_trip line;
  for (int i = 0; i < 60; ++i)
    line.sample((i % 3 == 2 ? 290 : 30) * ms);
  EXPECT_LT(line.timeout_ns(), 60 * ms);
}

TEST(round_trip, an_answer_right_after_a_resend_shows_that_the_line_has_become_slower) {
  round_trip line;
  for (int i = 0; i < 20; ++i)
    line.sample(30 * ms);
  line.ambiguous_sample(5 * ms, 45 * ms);
  EXPECT_GT(line.smoothed_ns(), 30 * ms);
}

TEST(round_trip, any_other_ambiguous_answer_changes_nothing) {
  round_trip line;
  line.sample(30 * ms);
  const auto before = line.timeout_ns();
  line.ambiguous_sample(31 * ms, 90 * ms);
  line.ambiguous_sample(5 * ms, std::nullopt);
  EXPECT_EQ(line.timeout_ns(), before);
}

TEST(round_trip, while_nothing_is_certain_the_guess_grows_with_silence_and_shrinks_a_few_times) {
  round_trip line;
  line.on_silence();
  EXPECT_GT(line.timeout_ns(), round_trip::first_timeout_ns);
  for (int i = 0; i < 10; ++i) {
    line.ambiguous_sample(30 * ms, std::nullopt);
    line.on_silence();
  }
  EXPECT_GT(line.timeout_ns(), round_trip::first_timeout_ns) << "a slow line is not flooded for ever";
  line.sample(30 * ms);
  EXPECT_LT(line.timeout_ns(), 100 * ms);
}

TEST(round_trip, never_waits_longer_than_its_bound) {
  round_trip line;
  for (int i = 0; i < 20; ++i)
    line.sample(60'000 * ms);
  EXPECT_LE(line.timeout_ns(), round_trip::max_timeout_ns);
}

TEST(round_trip, knows_what_can_not_be_an_answer) {
  round_trip line;
  EXPECT_FALSE(line.is_too_soon(0));
  line.sample(100 * ms);
  EXPECT_TRUE(line.is_too_soon(50 * ms));
  EXPECT_FALSE(line.is_too_soon(90 * ms));
}

} // namespace round_trip_test
} // namespace godwit::vehicle_link::transfer
