#include "actors/ground_port/settings.hpp"

#include <gtest/gtest.h>

namespace godwit::ground_port {
namespace settings_test {

TEST(ground_port_settings, the_defaults_can_be_used) { EXPECT_EQ(objection_to({}), std::nullopt); }

TEST(ground_port_settings, component_1_is_refused_where_the_autopilot_is_on_the_same_line) {
  settings given;
  given.as.component = 1;
  EXPECT_EQ(objection_to(given), std::nullopt);
  given.autopilot_is_on_this_line = true;
  EXPECT_TRUE(objection_to(given));
  given.as.component = 191;
  EXPECT_EQ(objection_to(given), std::nullopt);
}

TEST(ground_port_settings, the_ids_that_mean_all_are_refused) {
  settings given;
  given.as.system = 0;
  EXPECT_TRUE(objection_to(given));
  given = {};
  given.as.component = 0;
  EXPECT_TRUE(objection_to(given));
}

TEST(ground_port_settings, numbers_out_of_range_are_refused) {
  settings given;
  given.heartbeat_ms = 0;
  EXPECT_TRUE(objection_to(given));
  given = {};
  given.max_items = 0;
  EXPECT_TRUE(objection_to(given));
  given.max_items = max_plan_items + 1;
  EXPECT_TRUE(objection_to(given));
}

} // namespace settings_test
} // namespace godwit::ground_port
