#include <gtest/gtest.h>

#include "actors/failsafe/overrides.hpp"

namespace overrides_test {

using namespace godwit::failsafe;

constexpr std::int64_t wall_s = 1'700'000'000;

instant at(std::int64_t s) { return {s * ns_per_s, (wall_s + s) * ns_per_s}; }

override_rule until(std::int64_t s, rule scope = rule::operator_link) {
  return {.scope = scope, .reason = "range test", .until_ns = at(s).wall_ns};
}

TEST(overrides, one_holds_for_its_scope_until_its_deadline) {
  overrides all({}, at(0));
  ASSERT_TRUE(all.take(until(60), at(0)));
  EXPECT_TRUE(all.holds(rule::operator_link));
  EXPECT_FALSE(all.holds(rule::fence));
  all.expire({60 * ns_per_s - 1, 0});
  EXPECT_TRUE(all.holds(rule::operator_link));
  all.expire(at(60));
  EXPECT_FALSE(all.holds(rule::operator_link));
}

TEST(overrides, a_critical_battery_can_never_be_overridden) {
  overrides all({}, at(0));
  const auto refused = all.take(until(60, rule::battery_critical), at(0));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error(), "a critical battery can not be overridden");
  EXPECT_FALSE(all.holds(rule::battery_critical));
}

TEST(overrides, not_even_by_what_is_read_back) {
  const overrides all({{rule::battery_critical, "forged", at(60).wall_ns}}, at(0));
  EXPECT_FALSE(all.holds(rule::battery_critical));
}

TEST(overrides, a_fence_a_low_battery_and_the_operators_link_can) {
  overrides all({}, at(0));
  for (const auto scope : {rule::fence, rule::battery_low, rule::operator_link}) {
    EXPECT_TRUE(all.take(until(60, scope), at(0)));
    EXPECT_TRUE(all.holds(scope));
  }
}

TEST(overrides, one_without_a_reason_is_refused) {
  overrides all({}, at(0));
  auto nameless = until(60);
  nameless.reason.clear();
  EXPECT_FALSE(all.take(nameless, at(0)));
}

TEST(overrides, one_whose_deadline_has_passed_or_is_too_far_away_is_refused) {
  overrides all({}, at(0));
  EXPECT_FALSE(all.take(until(0), at(0)));
  EXPECT_FALSE(all.take(until(3'601), at(0)));
  EXPECT_TRUE(all.take(until(3'600), at(0)));
}

TEST(overrides, a_new_one_replaces_the_one_before) {
  overrides all({}, at(0));
  (void)all.take(until(600), at(0));
  (void)all.take(until(60), at(0));
  ASSERT_EQ(all.all().size(), 1U);
  all.expire(at(60));
  EXPECT_FALSE(all.holds(rule::operator_link));
}

TEST(overrides, a_long_reason_is_cut) {
  overrides all({}, at(0));
  auto wordy = until(60);
  wordy.reason.assign(10'000, 'x');
  ASSERT_TRUE(all.take(wordy, at(0)));
  EXPECT_EQ(all.all().at(0).reason.size(), max_override_reason);
}

TEST(overrides, they_survive_a_restart_with_what_is_left_of_them) {
  overrides all({}, at(0));
  (void)all.take(until(60), at(0));
  const instant rebooted{5 * ns_per_s, at(20).wall_ns}; // the monotonic clock began anew
  overrides restored(all.all(), rebooted);
  EXPECT_TRUE(restored.holds(rule::operator_link));
  restored.expire({44 * ns_per_s, 0});
  EXPECT_TRUE(restored.holds(rule::operator_link));
  restored.expire({45 * ns_per_s, 0});
  EXPECT_FALSE(restored.holds(rule::operator_link));
  EXPECT_FALSE(overrides(all.all(), at(60)).holds(rule::operator_link)) << "it ended meanwhile";
}

TEST(overrides, a_jump_of_the_wall_clock_neither_ends_nor_prolongs_one) {
  overrides all({}, at(0));
  (void)all.take(until(60), at(0));
  all.expire({1 * ns_per_s, at(3'600).wall_ns});
  EXPECT_TRUE(all.holds(rule::operator_link));
  all.expire({60 * ns_per_s, at(-3'600).wall_ns});
  EXPECT_FALSE(all.holds(rule::operator_link));
}

} // namespace overrides_test
