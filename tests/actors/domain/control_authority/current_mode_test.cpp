// What CURRENT_MODE tells of who has the vehicle: between two heartbeats, and by the mode that somebody has asked for.
#include <gtest/gtest.h>

#include "actors/domain/control_authority/control_authority.hpp"
#include "tests/actors/domain/control_authority/vehicles.hpp"
#include "tests/support/time_units.hpp"

namespace godwit::flight {
namespace current_mode_test {

using io::mavlink::mav_autopilot;

using tests::px4;

constexpr flight_mode position_control{mode_kind::manual, 3U << 16U};
constexpr flight_mode mission{mode_kind::mission, 4U << 16U | 4U << 24U};
constexpr flight_mode hold{mode_kind::hold, 4U << 16U | 3U << 24U};
constexpr flight_mode returning{mode_kind::returning, 4U << 16U | 5U << 24U};
constexpr flight_mode land{mode_kind::landing, 4U << 16U | 6U << 24U};

using godwit::tests::s;
using tests::last_item;

void tell(control_authority& who, const flight_mode& actual, const flight_mode& intended, std::int64_t now_ns) {
  who.on_current_mode(px4, {actual, false, intended.custom_mode}, now_ns);
}

void beat(control_authority& who, const flight_mode& mode, std::int64_t now_ns) {
  who.on_mode(px4, mode, false, now_ns);
}

// On its mission, and has said so.
control_authority in_flight() {
  control_authority result;
  result.begin(mission);
  tell(result, mission, mission, 0);
  return result;
}

TEST(current_mode, a_person_is_seen_before_the_next_heartbeat) {
  for (const auto& mode : {position_control, returning, land}) {
    auto who = in_flight();
    tell(who, mode, mode, s);
    EXPECT_EQ(who.who(), holder::person) << io::name_of(mode.kind);
  }
}

TEST(current_mode, where_the_actual_mode_alone_has_changed_the_autopilots_own_failsafe_has_it) {
  for (const auto& mode : {hold, returning, land}) {
    auto who = in_flight();
    tell(who, mode, mission, s);
    EXPECT_EQ(who.who(), holder::autopilot_failsafe) << io::name_of(mode.kind);
  }
}

TEST(current_mode, a_failsafe_that_a_heartbeat_has_shown_first_is_called_so_for_three_seconds) {
  auto soon = in_flight();
  beat(soon, returning, s);
  ASSERT_EQ(soon.who(), holder::person);
  auto late = soon;
  tell(soon, returning, mission, 4 * s);
  EXPECT_EQ(soon.who(), holder::autopilot_failsafe);
  tell(late, returning, mission, 4 * s + 1);
  EXPECT_EQ(late.who(), holder::person);
}

TEST(current_mode, who_has_asked_for_the_mode_that_it_is_in_is_a_person_also_when_a_failsafe_follows) {
  auto who = in_flight();
  beat(who, position_control, s);
  tell(who, position_control, position_control, s + s / 4);
  tell(who, returning, position_control, s + s / 2);
  EXPECT_EQ(who.who(), holder::person);
}

TEST(current_mode, a_failsafe_that_takes_the_mode_of_an_order_that_was_lost_is_not_its_obedience) {
  auto by_heartbeat = in_flight();
  by_heartbeat.expect({returning.custom_mode}, 0, 10 * s);
  beat(by_heartbeat, returning, s);
  ASSERT_EQ(by_heartbeat.who(), holder::godwit);
  tell(by_heartbeat, returning, mission, s + s / 2);
  EXPECT_EQ(by_heartbeat.who(), holder::autopilot_failsafe);
  auto at_once = in_flight();
  at_once.expect({returning.custom_mode}, 0, 10 * s);
  tell(at_once, returning, mission, s);
  EXPECT_EQ(at_once.who(), holder::autopilot_failsafe);
}

TEST(current_mode, an_order_that_is_obeyed_is_ours_whichever_tells_it_first) {
  for (const bool beats_first : {false, true}) {
    auto who = in_flight();
    who.expect({hold.custom_mode}, 0, 10 * s);
    if (beats_first)
      beat(who, hold, s);
    tell(who, hold, hold, s + s / 2);
    EXPECT_FALSE(who.is_unclear());
    beat(who, hold, 2 * s);
    EXPECT_EQ(who.who(), holder::godwit);
    tell(who, position_control, position_control, 3 * s);
    EXPECT_EQ(who.who(), holder::person);
  }
}

TEST(current_mode, an_order_that_is_not_obeyed_yet_is_nobodys_takeover) {
  auto who = in_flight();
  who.expect({hold.custom_mode}, 0, 10 * s);
  tell(who, mission, hold, s);
  EXPECT_EQ(who.who(), holder::godwit);
}

TEST(current_mode, who_asks_for_a_mode_that_the_vehicle_can_not_enter_has_it_all_the_same) {
  auto who = in_flight();
  tell(who, mission, position_control, s);
  EXPECT_EQ(who.who(), holder::person);
}

TEST(current_mode, a_failsafe_in_which_it_was_handed_back_does_not_take_it_again) {
  auto who = in_flight();
  tell(who, returning, mission, s);
  ASSERT_EQ(who.who(), holder::autopilot_failsafe);
  who.begin(returning);
  tell(who, returning, mission, 2 * s);
  tell(who, returning, mission, 3 * s);
  EXPECT_EQ(who.who(), holder::godwit);
  tell(who, land, mission, 4 * s);
  EXPECT_EQ(who.who(), holder::autopilot_failsafe) << "another one does";
}

// A disarm may have led there, and CURRENT_MODE does not tell of it.
TEST(current_mode, what_may_follow_from_a_disarm_waits_for_the_heartbeat_and_nothing_is_sent_until_then) {
  auto taken = in_flight();
  tell(taken, hold, hold, s);
  EXPECT_TRUE(taken.is_unclear());
  EXPECT_TRUE(taken.is_ours());
  auto disarmed = taken;
  beat(taken, hold, 2 * s);
  EXPECT_EQ(taken.who(), holder::person);
  disarmed.expect_also({mission.custom_mode, hold.custom_mode}, 2 * s, 7 * s);
  beat(disarmed, hold, 2 * s);
  EXPECT_EQ(disarmed.who(), holder::godwit);
  EXPECT_FALSE(disarmed.is_unclear());
}

TEST(current_mode, the_end_of_a_plan_is_told_as_by_heartbeats) {
  auto who = in_flight();
  who.set_plan_end({last_item, true, {returning.custom_mode}});
  tell(who, returning, returning, s);
  EXPECT_TRUE(who.is_unclear());
  who.on_place(last_item, false, s + s / 10);
  EXPECT_EQ(who.who(), holder::autopilot_end);
}

TEST(current_mode, a_vehicle_that_does_not_tell_what_was_asked_for_is_judged_by_its_mode) {
  control_authority who;
  who.begin(mission);
  who.on_current_mode(px4, {mission, false, 0}, 0);
  EXPECT_EQ(who.who(), holder::godwit);
  who.on_current_mode(px4, {returning, false, 0}, s);
  EXPECT_EQ(who.who(), holder::person);
}

TEST(current_mode, after_a_restart_a_return_that_nobody_has_asked_for_is_the_autopilots) {
  control_authority who;
  who.resume({mission.custom_mode}, 0);
  tell(who, returning, mission, s / 2);
  EXPECT_EQ(who.who(), holder::autopilot_failsafe);
}

TEST(current_mode, nobody_is_watched_outside_of_a_flight) {
  control_authority who;
  tell(who, position_control, position_control, 0);
  EXPECT_EQ(who.who(), holder::godwit);
}

} // namespace current_mode_test
} // namespace godwit::flight
