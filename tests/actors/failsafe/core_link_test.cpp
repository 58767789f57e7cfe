// The core: the operator's link.
#include <algorithm>

#include <gtest/gtest.h>

#include "tests/actors/failsafe/flights.hpp"

namespace core_link_test {

using namespace godwit::failsafe;
using namespace godwit::tests;

TEST(failsafe_core, operator_link_lost_nothing_at_25_s_and_return_at_30_s) {
  for (const auto what : classes) {
    flight_world world(what);
    world.run_s(10);
    const auto last_heard_ms = world.now_ms() - 100;
    world.operator_there = false;
    world.run_s(25);
    EXPECT_TRUE(world.sent.empty());
    EXPECT_EQ(std::ranges::count(world.warnings, "the operator's ground station is silent"), 1) << "degraded";
    world.run_s(6);
    EXPECT_EQ(actions_of(world), these{action::return_home});
    EXPECT_NEAR(static_cast<double>(*world.first_sent_ms - last_heard_ms), 30'000, 200);
  }
}

TEST(failsafe_core, the_link_that_comes_back_does_not_cancel_the_return) {
  flight_world world;
  world.run_s(10);
  world.operator_there = false;
  world.run_s(40);
  world.operator_there = true;
  world.run_s(60);
  EXPECT_EQ(actions_of(world), these{action::return_home});
  EXPECT_TRUE(world.lifted.empty());
  EXPECT_EQ(world.mode, in_return);
  EXPECT_TRUE(world.has_warned_of("heard again"));
}

TEST(failsafe_core, an_operators_override_cancels_the_return_and_sends_nothing_by_itself) {
  flight_world world;
  world.run_s(10);
  world.operator_there = false;
  world.run_s(40);
  world.override_for_s(rule::operator_link, 600);
  world.run_s(1);
  ASSERT_EQ(world.answered.size(), 1U);
  EXPECT_TRUE(world.answered[0].taken);
  ASSERT_EQ(world.lifted.size(), 1U);
  EXPECT_EQ(world.lifted[0].why, rule::operator_link);
  world.run_s(120);
  EXPECT_EQ(world.sent.size(), 1U) << "the return from before";
}

TEST(failsafe_core, at_the_deadline_of_an_override_the_rule_acts_when_its_cause_is_still_there) {
  flight_world world;
  world.run_s(10);
  world.override_for_s(rule::operator_link, 120);
  world.operator_there = false;
  world.run_s(119);
  EXPECT_TRUE(world.sent.empty());
  world.run_s(2);
  EXPECT_EQ(actions_of(world), these{action::return_home});
}

TEST(failsafe_core, while_an_object_is_followed_the_link_may_be_lost_30_s_longer) {
  flight_world world;
  world.run_s(10);
  world.tell(following{true});
  world.operator_there = false;
  world.run_s(59);
  EXPECT_TRUE(world.sent.empty());
  world.run_s(2);
  EXPECT_EQ(actions_of(world), these{action::return_home});
}

TEST(failsafe_core, an_operator_who_was_never_seen_is_never_lost_except_when_required) {
  for (const auto policy :
       {operator_link_policy::off, operator_link_policy::once_seen, operator_link_policy::required}) {
    flight_world world(vehicle_class::multirotor, {.operator_link = policy});
    world.operator_there = false;
    world.run_s(60);
    EXPECT_EQ(world.sent.size(), policy == operator_link_policy::required ? 1U : 0U);
  }
}

TEST(failsafe_core, with_operator_link_off_nobody_is_missed) {
  flight_world world(vehicle_class::multirotor, {.operator_link = operator_link_policy::off});
  world.run_s(10);
  world.operator_there = false;
  world.run_s(60);
  EXPECT_TRUE(world.sent.empty());
}

TEST(failsafe_core, a_ground_port_that_is_dead_is_an_operator_who_is_not_heard) {
  flight_world world;
  world.run_s(10);
  world.port_alive = false;
  world.run_s(31);
  EXPECT_EQ(actions_of(world), these{action::return_home});
}

// A person hands it back, and resumes the mission.
void go_on(flight_world& world) {
  world.tell(hand_back{});
  world.tell(expect_mode{{in_mission.custom_mode}, 5'000});
  world.mode = in_mission;
}

// Who hands it back has read why it comes home, and is there without the station.
TEST(failsafe_core, a_vehicle_that_is_handed_back_is_not_called_home_again_by_the_same_silence) {
  for (const bool is_port_alive : {true, false}) {
    flight_world world;
    world.run_s(10);
    world.operator_there = false;
    world.port_alive = is_port_alive;
    world.run_s(40);
    ASSERT_EQ(actions_of(world), these{action::return_home});
    go_on(world);
    world.run_s(120);
    EXPECT_EQ(actions_of(world), these{action::return_home}) << "once";
    EXPECT_TRUE(world.has_warned_of("handed back while the operator's ground station is silent"));
  }
}

TEST(failsafe_core, a_station_that_is_heard_again_after_the_hand_back_is_missed_again) {
  flight_world world;
  world.run_s(10);
  world.operator_there = false;
  world.run_s(40);
  go_on(world);
  world.run_s(60);
  world.operator_there = true;
  world.run_s(10);
  world.operator_there = false;
  world.run_s(25);
  EXPECT_EQ(world.sent.size(), 1U);
  world.run_s(6);
  EXPECT_EQ(world.sent.size(), 2U);
}

TEST(failsafe_core, where_an_operator_is_required_the_silence_counts_from_the_hand_back) {
  flight_world world(vehicle_class::multirotor, {.operator_link = operator_link_policy::required});
  world.run_s(10);
  world.operator_there = false;
  world.run_s(40);
  go_on(world);
  world.run_s(28);
  EXPECT_EQ(world.sent.size(), 1U);
  world.run_s(4);
  EXPECT_EQ(world.sent.size(), 2U);
}

} // namespace core_link_test
