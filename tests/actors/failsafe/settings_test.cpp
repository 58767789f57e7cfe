#include <limits>

#include <gtest/gtest.h>

#include "actors/failsafe/settings.hpp"

namespace settings_test {

using namespace godwit::failsafe;

TEST(failsafe_settings, the_defaults_are_those_of_the_table) {
  const settings defaults;
  EXPECT_FALSE(objection_to(defaults));
  EXPECT_EQ(defaults.battery_critical_percent, 15);
  EXPECT_EQ(defaults.battery_low_percent, 25);
  EXPECT_EQ(defaults.link_degraded_ms, 5'000);
  EXPECT_EQ(defaults.link_lost_ms, 30'000);
  EXPECT_EQ(defaults.operator_link, operator_link_policy::once_seen);
  EXPECT_FALSE(defaults.failsafe_in_manual);
}

TEST(failsafe_settings, what_makes_no_sense_is_refused_with_the_name_of_the_key) {
  const std::pair<settings, const char*> all[] = {
      {{.battery_critical_percent = 30}, "battery_critical_percent"},
      {{.battery_critical_percent = -1}, "battery_critical_percent"},
      {{.battery_low_percent = 101}, "battery_low_percent"},
      {{.link_degraded_ms = 40'000}, "link_degraded_ms"},
      {{.link_degraded_ms = 0}, "link_degraded_ms"},
      {{.following_extra_ms = -1}, "following_extra_ms"},
      {{.moving_mps = 0}, "moving_mps"},
      {{.moving_mps = std::numeric_limits<double>::quiet_NaN()}, "moving_mps"},
  };
  for (const auto& [each, key] : all)
    EXPECT_NE(objection_to(each).value_or("none").find(key), std::string::npos) << key;
}

} // namespace settings_test
