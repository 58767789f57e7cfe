#include "actors/executor/preflight/checks.hpp"

#include <gtest/gtest.h>

#include "tests/actors/executor/preflight/good_facts.hpp"

namespace godwit::executor::preflight {
namespace battery_test {

using namespace test;

result with(std::optional<std::int32_t> percent, const settings& set = {}) {
  auto seen = good_facts();
  seen.vehicle.battery_percent = percent;
  return check_battery(seen, set);
}

TEST(battery_check, passes_above_the_return_level_and_the_margin) {
  EXPECT_EQ(with(41).how, verdict::pass);
  EXPECT_EQ(with(100), pass("The battery is at 100 %."));
}

TEST(battery_check, fails_at_the_level_and_below_it_and_says_what_is_needed) {
  EXPECT_EQ(with(40), fail("The battery is at 40 %, and more than 40 % are needed to fly; put in a charged one."));
  EXPECT_EQ(with(0).how, verdict::fail);
}

TEST(battery_check, goes_by_the_settings) {
  EXPECT_EQ(with(61, {.battery_return_percent = 30, .battery_margin_percent = 30}).how, verdict::pass);
  EXPECT_EQ(with(60, {.battery_return_percent = 30, .battery_margin_percent = 30}).how, verdict::fail);
}

TEST(battery_check, degrades_when_the_autopilot_does_not_know_the_level) {
  EXPECT_EQ(with(-1).how, verdict::degraded);
  EXPECT_EQ(with(101), with(-1)) << "no battery is fuller than full";
}

TEST(battery_check, fails_before_anything_was_heard_of_it) { EXPECT_EQ(with(std::nullopt).how, verdict::fail); }

TEST(battery_check, is_skipped_while_the_vehicle_is_not_heard) {
  auto seen = good_facts();
  seen.vehicle.link = vehicle_link::connection_phase::lost;
  EXPECT_EQ(check_battery(seen, {}).how, verdict::skipped);
}

} // namespace battery_test
} // namespace godwit::executor::preflight
