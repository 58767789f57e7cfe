#include <gtest/gtest.h>

#include <set>

#include "runtime/supervision/supervision_core.hpp"

namespace restart_history_test {

using namespace godwit::runtime;
using namespace std::chrono_literals;

constexpr std::int64_t ns(milliseconds duration) { return std::chrono::nanoseconds(duration).count(); }

restart_policy exact() {
  restart_policy result{.intensity = 10, .period = 60s, .backoff_initial = 100ms, .backoff_max = 5s};
  result.jitter = 0;
  return result;
}

TEST(restart_history, the_first_crash_in_a_period_is_followed_by_a_restart_at_once) {
  restart_history history;
  random_source random(1);
  EXPECT_EQ(history.on_crash(restart_policy{}, 17, random), 0);
}

TEST(restart_history, the_wait_doubles_from_the_second_crash_on_up_to_its_maximum) {
  restart_history history;
  random_source random(1);
  const std::int64_t expected_ms[] = {0, 100, 200, 400, 800, 1'600, 3'200, 5'000, 5'000, 5'000};
  std::int64_t now_ns = 1;
  for (const auto each : expected_ms)
    EXPECT_EQ(history.on_crash(exact(), now_ns++, random), ns(milliseconds(each)));
}

TEST(restart_history, more_crashes_than_the_intensity_within_the_period_give_the_child_up) {
  for (const std::uint32_t intensity : {0U, 1U, 5U}) {
    restart_history history;
    random_source random(1);
    auto policy = exact();
    policy.intensity = intensity;
    for (std::uint32_t i = 0; i < intensity; ++i)
      EXPECT_TRUE(history.on_crash(policy, i, random)) << intensity;
    EXPECT_FALSE(history.on_crash(policy, intensity, random)) << intensity;
  }
}

TEST(restart_history, a_crash_as_old_as_the_period_is_forgotten) {
  restart_history history;
  random_source random(1);
  auto policy = exact();
  policy.intensity = 2;
  EXPECT_EQ(history.on_crash(policy, 0, random), 0);
  EXPECT_EQ(history.on_crash(policy, 1, random), ns(100ms));
  // The first has just left the period, the second is its last nanosecond in it.
  EXPECT_EQ(history.on_crash(policy, ns(60s), random), ns(100ms));
  EXPECT_FALSE(history.on_crash(policy, ns(60s), random));
  EXPECT_EQ(history.on_crash(policy, ns(120s), random), 0);
}

TEST(restart_history, forgetting_makes_the_next_crash_the_first) {
  restart_history history;
  random_source random(1);
  auto policy = exact();
  policy.intensity = 1;
  EXPECT_EQ(history.on_crash(policy, 0, random), 0);
  EXPECT_FALSE(history.on_crash(policy, 1, random));
  history.forget();
  EXPECT_EQ(history.on_crash(policy, 2, random), 0);
}

TEST(restart_history, the_jitter_stays_within_its_fraction_and_uses_it) {
  random_source random(7);
  std::int64_t least = ns(5s);
  std::int64_t most = 0;
  for (int i = 0; i < 10'000; ++i) {
    restart_history history;
    EXPECT_EQ(history.on_crash(restart_policy{}, 0, random), 0);
    const auto wait = history.on_crash(restart_policy{}, 1, random);
    ASSERT_TRUE(wait);
    least = std::min(least, *wait);
    most = std::max(most, *wait);
  }
  EXPECT_GE(least, ns(80ms));
  EXPECT_LT(least, ns(81ms));
  EXPECT_LE(most, ns(120ms));
  EXPECT_GT(most, ns(119ms));
}

TEST(restart_history, children_with_different_seeds_come_back_at_different_times) {
  std::set<std::int64_t> waits;
  constexpr std::size_t seeds = 100;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    restart_history history;
    random_source random(seed);
    EXPECT_TRUE(history.on_crash(restart_policy{}, 0, random));
    waits.insert(history.on_crash(restart_policy{}, 1, random).value_or(0));
  }
  EXPECT_EQ(waits.size(), seeds);
}

TEST(restart_history, the_same_seed_gives_the_same_waits) {
  restart_history first;
  restart_history second;
  random_source a(3);
  random_source b(3);
  for (std::int64_t crash = 0; crash < 7; ++crash)
    EXPECT_EQ(first.on_crash(restart_policy{}, crash, a), second.on_crash(restart_policy{}, crash, b));
}

} // namespace restart_history_test
