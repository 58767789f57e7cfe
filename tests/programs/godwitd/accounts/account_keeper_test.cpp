#include "programs/godwitd/accounts/account_keeper.hpp"

#include <gtest/gtest.h>

namespace login_delay_test {

using godwit::accounts::login_delay;

TEST(login_delay, grows_with_each_failure_in_a_row_up_to_8_s_and_never_locks) {
  login_delay delay;
  std::int64_t now = 1'000'000;
  std::int64_t longest = 0;
  EXPECT_EQ(delay.due_ms("anna", "::1", now), now);
  for (const std::int64_t wait : {250, 500, 1'000, 2'000, 4'000, 8'000, 8'000}) {
    delay.failed("anna", "::1", now);
    EXPECT_EQ(delay.due_ms("anna", "::1", now), now + wait);
    now += wait;
    longest = wait;
  }
  for (int i = 0; i < 1'000; ++i)
    delay.failed("anna", "::1", now);
  EXPECT_EQ(delay.due_ms("anna", "::1", now), now + longest);
}

TEST(login_delay, who_guesses_from_elsewhere_delays_nobody) {
  login_delay delay;
  for (int i = 0; i < 10; ++i)
    delay.failed("anna", "10.0.0.9", 1'000);
  EXPECT_EQ(delay.due_ms("anna", "10.0.0.1", 1'000), 1'000);
  EXPECT_GT(delay.due_ms("bob", "10.0.0.9", 1'000), 1'000) << "another name from there";
}

TEST(login_delay, a_success_and_ten_minutes_forget_it) {
  login_delay delay;
  delay.failed("anna", "::1", 1'000);
  delay.succeeded("anna", "::1");
  EXPECT_EQ(delay.due_ms("anna", "::1", 1'000), 1'000);
  delay.failed("anna", "::1", 1'000);
  EXPECT_EQ(delay.due_ms("anna", "::1", 1'000 + login_delay::forgotten_after_ms),
            1'000 + login_delay::forgotten_after_ms);
}

TEST(login_delay, keeps_a_bounded_number_of_addresses) {
  login_delay delay;
  for (int i = 0; i < 10'000; ++i)
    delay.failed("anna", "10.0." + std::to_string(i), i);
  EXPECT_GT(delay.due_ms("anna", "10.0.9999", 9'999), 9'999);
  EXPECT_EQ(delay.due_ms("anna", "10.0.0", 9'999), 9'999) << "the oldest is forgotten";
}

} // namespace login_delay_test
