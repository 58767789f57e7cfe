#include <gtest/gtest.h>

#include "actors/failsafe/rules.hpp"

namespace rules_test {

using namespace godwit::failsafe;

TEST(rules, a_critical_battery_lands_a_multirotor_returns_an_aeroplane_and_stops_a_rover) {
  EXPECT_EQ(action_for(rule::battery_critical, vehicle_class::multirotor, false), action::land);
  EXPECT_EQ(action_for(rule::battery_critical, vehicle_class::fixed_wing, false), action::return_home);
  EXPECT_EQ(action_for(rule::battery_critical, vehicle_class::rover, false), action::hold);
}

TEST(rules, an_aeroplane_with_a_critical_battery_takes_the_landing_of_its_mission_where_there_is_one) {
  EXPECT_EQ(action_for(rule::battery_critical, vehicle_class::fixed_wing, true), action::do_land_start);
  EXPECT_EQ(action_for(rule::battery_critical, vehicle_class::multirotor, true), action::land);
  EXPECT_EQ(action_for(rule::battery_critical, vehicle_class::rover, true), action::hold);
}

TEST(rules, a_breached_fence_returns_what_flies_and_stops_a_rover) {
  for (const bool has_land_start : {false, true}) {
    EXPECT_EQ(action_for(rule::fence, vehicle_class::multirotor, has_land_start), action::return_home);
    EXPECT_EQ(action_for(rule::fence, vehicle_class::fixed_wing, has_land_start), action::return_home);
    EXPECT_EQ(action_for(rule::fence, vehicle_class::rover, has_land_start), action::hold);
  }
}

TEST(rules, a_low_battery_and_a_lost_operator_return_every_vehicle) {
  for (const auto each : {rule::battery_low, rule::operator_link})
    for (const auto what : {vehicle_class::multirotor, vehicle_class::fixed_wing, vehicle_class::rover})
      EXPECT_EQ(action_for(each, what, true), action::return_home);
}

TEST(rules, nothing_is_done_with_a_vehicle_of_unknown_kind) {
  for (const auto each : rules)
    EXPECT_FALSE(action_for(each, vehicle_class::unknown, true));
}

TEST(rules, the_priorities_are_critical_battery_fence_low_battery_operator_link) {
  EXPECT_EQ(priority_of(rule::battery_critical), 1);
  EXPECT_EQ(priority_of(rule::fence), 2);
  EXPECT_EQ(priority_of(rule::battery_low), 3);
  EXPECT_EQ(priority_of(rule::operator_link), 4);
  EXPECT_TRUE(is_higher(rule::fence, rule::battery_low));
  EXPECT_FALSE(is_higher(rule::fence, rule::fence));
}

TEST(rules, only_the_critical_battery_can_not_be_overridden) {
  for (const auto each : rules)
    EXPECT_EQ(may_be_overridden(each), each != rule::battery_critical);
}

TEST(rules, who_lands_needs_no_return_and_who_returns_may_still_have_to_land) {
  EXPECT_TRUE(is_done_by(action::return_home, mode_kind::returning));
  EXPECT_TRUE(is_done_by(action::return_home, mode_kind::landing));
  EXPECT_TRUE(is_done_by(action::land, mode_kind::landing));
  EXPECT_FALSE(is_done_by(action::land, mode_kind::returning));
  EXPECT_TRUE(is_done_by(action::hold, mode_kind::hold));
  EXPECT_FALSE(is_done_by(action::hold, mode_kind::returning));
  EXPECT_FALSE(is_done_by(action::do_land_start, mode_kind::mission));
}

TEST(rules, each_action_leads_into_modes_of_its_own) {
  EXPECT_EQ(modes_of(action::land)[0], mode_kind::landing);
  EXPECT_EQ(modes_of(action::hold)[0], mode_kind::hold);
  EXPECT_EQ(modes_of(action::return_home)[0], mode_kind::returning);
  EXPECT_EQ(modes_of(action::do_land_start)[0], mode_kind::mission);
}

} // namespace rules_test

namespace latch_table_test {

using namespace godwit::failsafe;

TEST(latch_table, a_rule_is_latched_until_it_is_released) {
  latch_table table({});
  EXPECT_FALSE(table.holds(rule::fence));
  table.set(rule::fence, latch_kind::acted);
  EXPECT_TRUE(table.holds(rule::fence));
  EXPECT_FALSE(table.holds(rule::operator_link));
  table.release(rule::fence);
  EXPECT_FALSE(table.holds(rule::fence));
}

TEST(latch_table, there_is_one_latch_for_each_rule) {
  latch_table table({});
  table.set(rule::fence, latch_kind::left_to_pilot);
  table.set(rule::fence, latch_kind::acted);
  EXPECT_EQ(table.all(), (std::vector<latch>{{rule::fence, latch_kind::acted}}));
}

TEST(latch_table, it_begins_with_what_is_remembered_and_the_end_of_the_flight_frees_all) {
  latch_table table({{rule::fence, latch_kind::acted}, {rule::operator_link, latch_kind::covered}});
  EXPECT_TRUE(table.holds(rule::operator_link));
  table.release_all();
  EXPECT_TRUE(table.all().empty());
}

} // namespace latch_table_test
