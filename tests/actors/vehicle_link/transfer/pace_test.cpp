#include "actors/vehicle_link/transfer/pace.hpp"
#include "tests/support/time_units.hpp"

#include <gtest/gtest.h>

namespace godwit::vehicle_link::transfer {
namespace pace_test {

using godwit::tests::ms;

constexpr std::int64_t no_limit_ns = 1'000'000 * ms;

TEST(pace, before_the_first_answer_nothing_runs) { EXPECT_EQ(pace().runs_until_ns(no_limit_ns), 0); }

TEST(pace, answers_may_come_for_three_times_their_usual_interval) {
  pace answers;
  std::int64_t now = 0;
  for (int i = 0; i < 100; ++i)
    answers.on_answers(1, now += 20 * ms);
  EXPECT_NEAR(static_cast<double>(answers.runs_until_ns(no_limit_ns) - now), 60e6, 2e6);
}

TEST(pace, answers_are_waited_for_no_longer_than_the_limit) {
  pace answers;
  std::int64_t now = 0;
  for (int i = 0; i < 100; ++i)
    answers.on_answers(1, now += 20 * ms);
  EXPECT_EQ(answers.runs_until_ns(5 * ms), now + 5 * ms);
}

TEST(pace, several_answers_at_once_are_several_intervals) {
  pace answers;
  std::int64_t now = 0;
  for (int i = 0; i < 100; ++i)
    answers.on_answers(4, now += 80 * ms);
  EXPECT_NEAR(static_cast<double>(answers.runs_until_ns(no_limit_ns) - now), 60e6, 2e6);
}

TEST(pace, a_pause_after_a_stall_is_not_an_interval) {
  pace answers;
  std::int64_t now = 0;
  for (int i = 0; i < 100; ++i)
    answers.on_answers(1, now += 5 * ms);
  answers.on_stall(now + 100 * ms);
  answers.on_answers(1, now += 10'000 * ms);
  EXPECT_LT(answers.runs_until_ns(no_limit_ns) - now, 20 * ms);
}

TEST(lengthened, grows_by_half_up_to_its_limit) {
  EXPECT_EQ(lengthened(100, 0, 1'000), 100);
  EXPECT_EQ(lengthened(100, 2, 1'000), 225);
  EXPECT_EQ(lengthened(100, 50, 1'000), 1'000);
  EXPECT_EQ(lengthened(2'000, 5, 1'000), 2'000) << "what is longer by itself stays";
}

} // namespace pace_test
} // namespace godwit::vehicle_link::transfer
