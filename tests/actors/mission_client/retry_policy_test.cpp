#include "actors/mission_client/retry_policy.hpp"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>

#include <set>

namespace retry_policy_test {

using namespace godwit::mission_client;

TEST(mission_client_retry_policy, pauses_double_up_to_five_minutes_give_or_take_a_fifth) {
  std::int64_t plain = second_ns;
  for (std::uint32_t failed = 1; failed <= 40; ++failed) {
    const auto pause = pause_ns(failed, "key");
    EXPECT_GE(pause, plain * 4 / 5) << failed;
    EXPECT_LE(pause, plain * 6 / 5) << failed;
    plain = std::min(plain * 2, longest_pause_ns);
  }
}

TEST(mission_client_retry_policy, the_same_try_of_the_same_key_waits_the_same_and_keys_differ) {
  EXPECT_EQ(pause_ns(3, "a"), pause_ns(3, "a"));
  std::set<std::int64_t> pauses;
  for (const auto* key : {"a", "b", "c", "d", "e", "f", "g", "h"})
    pauses.insert(pause_ns(3, key));
  EXPECT_GT(pauses.size(), 6U);
}

TEST(mission_client_retry_policy, retry_after_is_the_least_and_an_hour_the_most_of_it) {
  EXPECT_EQ(pause_ns(1, "a", 90 * second_ns), 90 * second_ns);
  EXPECT_GT(pause_ns(9, "a", second_ns), 100 * second_ns);
  EXPECT_EQ(pause_ns(1, "a", 24 * 3'600 * second_ns), longest_retry_after_ns);
}

TEST(mission_client_retry_policy, the_tries_of_a_change_fit_into_its_window) {
  std::int64_t all = 0;
  for (std::uint32_t failed = 1; failed < change_tries; ++failed)
    all += change_pause_ns(failed, "a");
  EXPECT_LT(all, change_window_ns / 2);
}

TEST(mission_client_retry_policy, a_time_that_only_another_clock_can_have_noted_is_due) {
  EXPECT_TRUE(is_due(5, 5));
  EXPECT_FALSE(is_due(6, 5));
  EXPECT_FALSE(is_due(longest_retry_after_ns, 0));
  EXPECT_TRUE(is_due(longest_retry_after_ns + 1, 0));
}

TEST(mission_client_retry_policy, a_row_expires_24_hours_after_its_first_failure_and_not_before_it_failed) {
  EXPECT_FALSE(has_expired(0, 100 * delivery_window_ns));
  EXPECT_FALSE(has_expired(1, delivery_window_ns));
  EXPECT_TRUE(has_expired(1, delivery_window_ns + 1));
}

RC_GTEST_PROP(mission_client_retry_policy_property, a_pause_is_never_shorter_than_asked_nor_longer_than_an_hour, ()) {
  const auto failed = *rc::gen::inRange<std::uint32_t>(1, 1'000);
  const auto asked = *rc::gen::inRange<std::int64_t>(0, 2 * longest_retry_after_ns);
  const auto key = *rc::gen::arbitrary<std::string>();
  const auto pause = pause_ns(failed, key, asked);
  RC_ASSERT(pause >= std::min(asked, longest_retry_after_ns));
  RC_ASSERT(pause <= longest_retry_after_ns);
}

} // namespace retry_policy_test
