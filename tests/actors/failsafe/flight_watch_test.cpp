#include <limits>

#include <gtest/gtest.h>

#include "actors/failsafe/events.hpp"
#include "actors/failsafe/flight_watch.hpp"

namespace flight_watch_test {

using namespace godwit::failsafe;

constexpr auto s = ns_per_s;

flight_watch copter(bool armed, landed_state how, bool in_flight = false) {
  flight_watch result(in_flight, 0.2);
  result.on_heartbeat(vehicle_class::multirotor, armed, 0);
  result.on_landed(how);
  return result;
}

TEST(flight_watch, before_the_first_heartbeat_nothing_is_known) {
  flight_watch watch(false, 0.2);
  watch.on_landed(landed_state::in_air);
  const auto now = watch.evaluate(0);
  EXPECT_FALSE(now.link_up || now.may_act || now.in_flight);
}

TEST(flight_watch, armed_and_in_the_air_is_a_flight) {
  for (const auto how : {landed_state::in_air, landed_state::taking_off, landed_state::landing}) {
    auto watch = copter(true, how);
    const auto now = watch.evaluate(0);
    EXPECT_TRUE(now.may_act && now.in_flight && now.begins);
    EXPECT_FALSE(watch.evaluate(1).begins) << "begins once";
  }
}

TEST(flight_watch, on_the_ground_disarmed_or_unknown_is_none) {
  EXPECT_FALSE(copter(true, landed_state::on_ground).evaluate(0).may_act);
  EXPECT_FALSE(copter(false, landed_state::in_air).evaluate(0).may_act);
  EXPECT_FALSE(copter(true, landed_state::unknown).evaluate(0).may_act);
  EXPECT_FALSE(copter(true, landed_state::unknown).evaluate(0).landed_known);
}

TEST(flight_watch, a_rover_acts_while_it_moves) {
  flight_watch watch(false, 0.2);
  watch.on_heartbeat(vehicle_class::rover, true, 0);
  watch.on_speed(0.1);
  EXPECT_FALSE(watch.evaluate(0).may_act);
  watch.on_speed(0.5);
  EXPECT_TRUE(watch.evaluate(0).may_act);
  watch.on_speed(std::numeric_limits<double>::quiet_NaN());
  EXPECT_TRUE(watch.evaluate(0).may_act) << "what is no number says nothing";
  watch.on_speed(0);
  const auto stopped = watch.evaluate(0);
  EXPECT_FALSE(stopped.may_act);
  EXPECT_TRUE(stopped.in_flight) << "it is still on its way";
  watch.on_heartbeat(vehicle_class::rover, false, s);
  EXPECT_TRUE(watch.evaluate(s).ends);
}

TEST(flight_watch, a_rover_that_was_pushed_while_disarmed_is_not_on_its_way) {
  flight_watch watch(false, 0.2);
  watch.on_heartbeat(vehicle_class::rover, false, 0);
  watch.on_speed(2);
  EXPECT_FALSE(watch.evaluate(0).in_flight);
}

TEST(flight_watch, disarming_ends_the_flight) {
  auto watch = copter(true, landed_state::in_air);
  (void)watch.evaluate(0);
  watch.on_heartbeat(vehicle_class::multirotor, false, s);
  const auto now = watch.evaluate(s);
  EXPECT_TRUE(now.ends);
  EXPECT_FALSE(now.in_flight || now.may_act);
}

TEST(flight_watch, on_the_ground_for_2_s_ends_the_flight_and_a_flicker_does_not) {
  auto watch = copter(true, landed_state::in_air);
  (void)watch.evaluate(0);
  watch.on_landed(landed_state::on_ground);
  auto now = watch.evaluate(s);
  EXPECT_FALSE(now.may_act) << "at once";
  EXPECT_TRUE(now.in_flight);
  watch.on_landed(landed_state::in_air);
  now = watch.evaluate(2 * s);
  EXPECT_TRUE(now.may_act);
  EXPECT_FALSE(now.begins);
  watch.on_landed(landed_state::on_ground);
  (void)watch.evaluate(3 * s);
  EXPECT_TRUE(watch.evaluate(4 * s).in_flight);
  EXPECT_TRUE(watch.evaluate(5 * s - 1).in_flight);
  watch.on_heartbeat(vehicle_class::multirotor, true, 4 * s);
  EXPECT_TRUE(watch.evaluate(5 * s).ends);
}

// Seen of a real PX4: on the ground, landing, on the ground, a second and more apart.
TEST(flight_watch, what_is_in_the_air_again_soon_after_its_end_and_was_not_disarmed_bounces) {
  for (const bool was_disarmed : {false, true})
    for (const auto after_s : {1, 5}) {
      auto watch = copter(true, landed_state::landing);
      (void)watch.evaluate(0);
      watch.on_landed(landed_state::on_ground);
      (void)watch.evaluate(s);
      EXPECT_TRUE(watch.evaluate(3 * s).ends);
      watch.on_heartbeat(vehicle_class::multirotor, !was_disarmed, 3 * s);
      watch.on_heartbeat(vehicle_class::multirotor, true, (3 + after_s) * s);
      watch.on_landed(landed_state::landing);
      const auto again = watch.evaluate((3 + after_s) * s);
      EXPECT_TRUE(again.begins);
      EXPECT_EQ(again.is_bounce, !was_disarmed && after_s == 1) << was_disarmed << " " << after_s;
    }
}

TEST(flight_watch, while_the_autopilot_is_not_heard_nothing_acts_and_nothing_changes) {
  auto watch = copter(true, landed_state::in_air);
  (void)watch.evaluate(0);
  const auto now = watch.evaluate(5 * s);
  EXPECT_FALSE(now.link_up || now.may_act || now.ends);
  EXPECT_TRUE(now.in_flight);
}

TEST(flight_watch, a_flight_that_is_found_was_never_seen_on_the_ground) {
  EXPECT_TRUE(copter(true, landed_state::in_air).evaluate(0).is_found);
  auto watch = copter(true, landed_state::on_ground);
  (void)watch.evaluate(0);
  watch.on_landed(landed_state::taking_off);
  const auto now = watch.evaluate(1);
  EXPECT_TRUE(now.begins && now.near_ground);
  EXPECT_FALSE(now.is_found);
}

TEST(flight_watch, a_flight_that_is_remembered_does_not_begin_again_and_may_have_ended_meanwhile) {
  EXPECT_FALSE(copter(true, landed_state::in_air, true).evaluate(0).begins);
  EXPECT_TRUE(copter(false, landed_state::unknown, true).evaluate(0).ends);
  EXPECT_FALSE(copter(true, landed_state::unknown, true).evaluate(0).ends);
}

} // namespace flight_watch_test
