#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "actors/failsafe/battery_filter.hpp"
#include "actors/failsafe/events.hpp"

namespace battery_filter_test {

using namespace godwit::failsafe;

constexpr auto s = ns_per_s;

// One sample a second, from FIRST_S on.
std::int64_t feed(battery_filter& filter, std::initializer_list<int> samples, int first_s = 0) {
  auto at_s = first_s;
  for (const auto percent : samples)
    filter.on_sample(percent, at_s++ * s);
  return (at_s - 1) * s;
}

TEST(battery_filter, critical_is_15_percent_for_5_s_and_3_samples) {
  battery_filter filter(15, 25);
  feed(filter, {15, 15, 15, 15, 15, 15});
  EXPECT_FALSE(filter.judge(5 * s - 1).critical);
  EXPECT_TRUE(filter.judge(5 * s).critical);
}

TEST(battery_filter, low_is_25_percent_with_the_same_filter) {
  battery_filter filter(15, 25);
  feed(filter, {25, 25, 25, 25, 25, 25});
  EXPECT_FALSE(filter.judge(5 * s - 1).low);
  EXPECT_TRUE(filter.judge(5 * s).low);
  EXPECT_FALSE(filter.judge(5 * s).critical);
}

TEST(battery_filter, one_percent_above_the_threshold_is_not_below_it) {
  battery_filter filter(15, 25);
  const auto now = feed(filter, {26, 26, 26, 26, 26, 26, 26, 26});
  EXPECT_FALSE(filter.judge(now).low);
  EXPECT_TRUE(filter.judge(now).known);
}

TEST(battery_filter, two_samples_are_not_enough_however_far_apart) {
  battery_filter filter(15, 25);
  filter.on_sample(10, 0);
  filter.on_sample(10, 7 * s);
  EXPECT_FALSE(filter.judge(8 * s).critical);
  filter.on_sample(10, 8 * s);
  EXPECT_TRUE(filter.judge(8 * s).critical);
}

TEST(battery_filter, samples_from_before_a_rise_count_no_more) {
  battery_filter filter(15, 25);
  feed(filter, {15, 16, 15});
  filter.on_sample(15, 8 * s);
  EXPECT_FALSE(filter.judge(8 * s).critical) << "two samples since the rise";
}

TEST(battery_filter, a_full_battery_is_known_and_more_than_full_is_not) {
  battery_filter full(15, 25);
  EXPECT_TRUE(full.judge(feed(full, {100, 100, 100})).known);
  battery_filter more(15, 25);
  EXPECT_FALSE(more.judge(feed(more, {101, 101, 101})).known);
}

TEST(battery_filter, many_samples_are_not_enough_before_5_s) {
  battery_filter filter(15, 25);
  for (int i = 0; i < 49; ++i)
    filter.on_sample(10, i * s / 10);
  EXPECT_FALSE(filter.judge(49 * s / 10).critical);
}

TEST(battery_filter, one_sample_above_begins_the_count_anew) {
  battery_filter filter(15, 25);
  feed(filter, {15, 15, 15, 16, 15, 15, 15, 15, 15});
  EXPECT_FALSE(filter.judge(8 * s).critical);
  filter.on_sample(15, 9 * s);
  EXPECT_TRUE(filter.judge(9 * s).critical);
}

TEST(battery_filter, a_jump_of_more_than_20_points_in_a_second_is_unknown) {
  battery_filter filter(15, 25);
  feed(filter, {60, 60, 39});
  EXPECT_FALSE(filter.judge(2 * s).known);
  battery_filter other(15, 25);
  feed(other, {60, 60, 40});
  EXPECT_TRUE(other.judge(2 * s).known) << "20 points are no jump";
}

TEST(battery_filter, a_jump_in_small_steps_within_a_second_is_a_jump) {
  battery_filter filter(15, 25);
  filter.on_sample(60, 0);
  filter.on_sample(48, s * 4 / 10);
  filter.on_sample(36, s * 8 / 10);
  EXPECT_FALSE(filter.judge(s).known);
}

TEST(battery_filter, a_late_sample_does_not_hide_a_jump) {
  battery_filter filter(15, 25);
  filter.on_sample(80, 0);
  filter.on_sample(10, s + s / 10);
  EXPECT_FALSE(filter.judge(s + s / 10).known);
}

TEST(battery_filter, a_fall_over_many_seconds_is_no_jump) {
  battery_filter filter(15, 25);
  filter.on_sample(80, 0);
  filter.on_sample(25, 4 * s);
  EXPECT_TRUE(filter.judge(4 * s).known);
}

TEST(battery_filter, after_a_jump_a_steady_gauge_is_believed_again) {
  battery_filter filter(15, 25);
  feed(filter, {80, 10, 10, 10, 10, 10, 10});
  EXPECT_FALSE(filter.judge(6 * s).critical) << "the sample that jumped does not count";
  filter.on_sample(10, 7 * s);
  EXPECT_TRUE(filter.judge(7 * s).critical);
}

TEST(battery_filter, a_gauge_that_jumps_all_the_time_never_acts) {
  battery_filter filter(15, 25);
  for (int i = 0; i < 60; ++i) {
    filter.on_sample(i % 2 == 0 ? 10 : 60, i * s);
    EXPECT_FALSE(filter.judge(i * s).critical);
  }
}

TEST(battery_filter, minus_one_is_unknown_and_begins_the_count_anew) {
  battery_filter filter(15, 25);
  feed(filter, {10, 10, 10, 10, -1});
  EXPECT_FALSE(filter.judge(4 * s).known);
  feed(filter, {10, 10, 10, 10, 10}, 5);
  EXPECT_FALSE(filter.judge(9 * s).critical);
  EXPECT_TRUE(filter.judge(10 * s).critical);
}

TEST(battery_filter, what_is_no_percentage_is_unknown) {
  battery_filter filter(15, 25);
  filter.on_sample(101, 0);
  EXPECT_FALSE(filter.judge(0).known);
}

TEST(battery_filter, without_a_sample_nothing_is_known) { EXPECT_FALSE(battery_filter(15, 25).judge(0).known); }

TEST(battery_filter, a_gauge_that_falls_silent_is_unknown_and_what_it_said_counts_no_more) {
  battery_filter filter(15, 25);
  feed(filter, {10, 10, 10, 10, 10, 10});
  EXPECT_TRUE(filter.judge(15 * s).critical);
  EXPECT_FALSE(filter.judge(15 * s + 1).known);
  filter.on_sample(10, 16 * s);
  EXPECT_FALSE(filter.judge(16 * s).critical);
  EXPECT_TRUE(filter.judge(16 * s).known);
}

TEST(battery_filter, a_gauge_that_says_too_much_is_heard_with_its_newest_samples) {
  battery_filter filter(15, 25);
  for (int i = 0; i < 10'000; ++i)
    filter.on_sample(50, i);
  EXPECT_TRUE(filter.judge(10'000).known);
}

RC_GTEST_PROP(battery_filter_property, it_acts_only_on_3_samples_and_5_s_that_all_agree, ()) {
  const auto samples = *rc::gen::container<std::vector<std::pair<int, int>>>(
      rc::gen::pair(rc::gen::inRange(-1, 30), rc::gen::inRange(100, 3000)));
  battery_filter filter(15, 25);
  std::int64_t now = 0;
  std::optional<std::int64_t> below_since;
  int count = 0;
  for (const auto& [percent, gap_ms] : samples) {
    now += gap_ms * ns_per_ms;
    filter.on_sample(percent, now);
    const bool below = percent >= 0 && percent <= 15;
    if (below && !below_since)
      below_since = now;
    if (!below)
      below_since.reset();
    count = below ? count + 1 : 0;
    if (filter.judge(now).critical)
      RC_ASSERT(below_since && count >= 3 && now - *below_since >= 5 * s);
    RC_ASSERT(!filter.judge(now).critical || filter.judge(now).low);
  }
}

} // namespace battery_filter_test
