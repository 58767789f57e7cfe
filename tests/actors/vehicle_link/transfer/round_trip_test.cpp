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
  line.ambiguous_sample({5 * ms, 40 * ms, 45 * ms});
  EXPECT_GT(line.smoothed_ns(), 30 * ms);
}

TEST(round_trip, any_other_ambiguous_answer_changes_nothing) {
  round_trip line;
  line.sample(30 * ms);
  const auto before = line.timeout_ns();
  line.ambiguous_sample({31 * ms, 59 * ms, 90 * ms});
  line.ambiguous_sample({5 * ms, 34 * ms, std::nullopt});
  EXPECT_EQ(line.timeout_ns(), before);
}

TEST(round_trip, while_nothing_is_certain_the_guess_grows_with_silence_and_shrinks_a_few_times) {
  round_trip line;
  line.on_silence();
  EXPECT_GT(line.timeout_ns(), round_trip::first_timeout_ns);
  for (int i = 0; i < 10; ++i) {
    line.ambiguous_sample({30 * ms, 100 * ms, std::nullopt});
    line.on_silence();
  }
  EXPECT_GT(line.timeout_ns(), round_trip::first_timeout_ns) << "a slow line is not flooded for ever";
  line.sample(30 * ms);
  EXPECT_LT(line.timeout_ns(), 100 * ms);
}

TEST(round_trip, two_ambiguous_answers_that_agree_are_certain_if_their_copies_lay_otherwise_apart) {
  round_trip line;
  line.ambiguous_sample({30 * ms, 100 * ms, std::nullopt});
  line.ambiguous_sample({31 * ms, 104 * ms, std::nullopt});
  EXPECT_FALSE(line.is_certain()) << "130 and 135 ms, answers to the copies before, look the same";
  line.ambiguous_sample({30 * ms, 150 * ms, std::nullopt});
  EXPECT_TRUE(line.is_certain());
  EXPECT_LT(line.timeout_ns(), 100 * ms);
}

TEST(round_trip, ambiguous_answers_that_differ_are_never_certain) {
  round_trip line;
  line.ambiguous_sample({100 * ms, 0, std::nullopt}); // an answer after 300 ms, however often it is asked for
  line.ambiguous_sample({0 * ms, 300 * ms, std::nullopt});
  line.ambiguous_sample({90 * ms, 210 * ms, std::nullopt});
  line.ambiguous_sample({150 * ms, 150 * ms, std::nullopt});
  EXPECT_FALSE(line.is_certain());
}

TEST(round_trip, a_first_answer_that_may_be_the_vehicle_asking_again_needs_two_more) {
  round_trip line;
  line.sample(290 * ms);
  EXPECT_FALSE(line.is_certain());
  line.sample(30 * ms);
  EXPECT_EQ(line.smoothed_ns(), 30 * ms);
  round_trip slow;
  for (int i = 0; i < round_trip::outliers_believed; ++i) {
    EXPECT_FALSE(slow.is_certain());
    slow.sample(400 * ms);
    EXPECT_GT(slow.timeout_ns(), 400 * ms) << "the next answer comes before the time-out";
  }
  EXPECT_EQ(slow.smoothed_ns(), 400 * ms);
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
