#include "actors/ground_port/station_rules.hpp"

#include <gtest/gtest.h>

namespace godwit::ground_port {
namespace station_rules_test {

using mavlink::mav_result;
using operators::role;

TEST(ground_port_rules, without_operators_beside_them_stations_may_say_everything) {
  EXPECT_FALSE(station_rules(std::nullopt).look());
}

TEST(ground_port_rules, an_operator_may_while_nobody_has_control_and_not_before_that_is_known) {
  station_rules rules(role::operator_);
  EXPECT_EQ(rules.look()->result, mav_result::temporarily_rejected) << "not known yet";
  rules.on_control("");
  EXPECT_FALSE(rules.look());
  rules.on_control("anna");
  EXPECT_EQ(rules.look()->result, mav_result::temporarily_rejected);
  EXPECT_EQ(rules.look()->why, "anna has control");
  rules.on_control("");
  EXPECT_FALSE(rules.look());
}

TEST(ground_port_rules, a_viewer_may_not_whoever_has_control) {
  station_rules rules(role::viewer);
  EXPECT_EQ(rules.look()->result, mav_result::denied);
  rules.on_control("");
  EXPECT_EQ(rules.look()->result, mav_result::denied);
}

} // namespace station_rules_test
} // namespace godwit::ground_port
