#include "actors/domain/control_authority/control_authority.hpp"
#include "tests/actors/domain/control_authority/vehicles.hpp"
#include "tests/support/time_units.hpp"

#include <gtest/gtest.h>

namespace godwit::flight {
namespace control_authority_test {

using io::mavlink::mav_autopilot;

using tests::copter;
using tests::px4;

constexpr flight_mode stabilize{mode_kind::manual, 0};
constexpr flight_mode automatic{mode_kind::mission, 3};
constexpr flight_mode loiter{mode_kind::hold, 5};
constexpr flight_mode brake{mode_kind::hold, 17};
constexpr flight_mode px4_mission{mode_kind::mission, 4U << 16U | 4U << 24U};
constexpr flight_mode px4_hold{mode_kind::hold, 4U << 16U | 3U << 24U};

using godwit::tests::s;
using tests::last_item;

control_authority in_flight(const flight_mode& mode = automatic) {
  control_authority result;
  result.begin(mode);
  return result;
}

// The last item is a waypoint, after which PX4 holds.
control_authority near_its_end() {
  auto result = in_flight(px4_mission);
  result.set_plan_end({last_item, false, {px4_hold.custom_mode}});
  return result;
}

holder after(control_authority who, const flight_mode& mode, std::int64_t now_ns = 0) {
  who.on_mode(copter, mode, false, now_ns);
  return who.who();
}

TEST(control_authority, a_mode_that_nobody_has_ordered_is_a_persons) {
  EXPECT_EQ(after(in_flight(), automatic), holder::godwit);
  for (const auto& mode : {stabilize, loiter, brake})
    EXPECT_EQ(after(in_flight(), mode), holder::person);
}

TEST(control_authority, an_order_is_obeyed_by_the_exact_mode_and_not_by_another_of_its_kind) {
  auto who = in_flight();
  who.expect({brake.custom_mode}, 0, 5 * s);
  EXPECT_EQ(after(who, brake), holder::godwit);
  EXPECT_EQ(after(who, loiter), holder::person) << "the hold was lost, and a pilot took LOITER";
}

TEST(control_authority, what_was_ordered_is_expected_once) {
  auto who = in_flight();
  who.expect({brake.custom_mode}, 0, 60 * s);
  who.on_mode(copter, brake, false, 0);
  who.expect({automatic.custom_mode}, 0, 60 * s);
  who.on_mode(copter, automatic, false, s);
  EXPECT_EQ(after(who, brake, 3 * s), holder::person);
}

TEST(control_authority, an_order_that_is_not_obeyed_in_time_is_expected_no_more) {
  auto who = in_flight();
  who.expect({brake.custom_mode}, 0, 5 * s);
  for (int beat = 1; beat < 5; ++beat)
    who.on_heartbeat(beat * s);
  EXPECT_EQ(after(who, brake, 5 * s), holder::person);
}

// Nobody could have seen it obeyed: what comes first may be its effect, and then it counts for as long as it had left.
TEST(control_authority, a_silence_in_which_an_order_that_moves_would_have_expired_does_not_count) {
  constexpr flight_mode goes_home{mode_kind::returning, 6};
  auto who = in_flight();
  who.expect({goes_home.custom_mode}, 0, 5 * s);
  who.on_heartbeat(s);
  EXPECT_EQ(after(who, goes_home, 40 * s), holder::godwit);
  EXPECT_EQ(after(who, loiter, 40 * s), holder::person) << "no order names it";
  for (const int heard_s : {40, 41, 42, 43}) // and is in its old mode still
    who.on_heartbeat(heard_s * s);
  EXPECT_EQ(after(who, goes_home, 43 * s), holder::godwit);
  who.on_heartbeat(44 * s);
  EXPECT_EQ(after(who, goes_home, 44 * s), holder::person);
}

// Seen on a real rover: its hold was lost, a person stopped it in the silence, and the replan drove on.
TEST(control_authority, a_hold_after_a_silence_is_that_of_a_person_who_has_stopped_it) {
  auto who = in_flight();
  who.expect({brake.custom_mode, automatic.custom_mode}, 0, 5 * s);
  who.on_heartbeat(s);
  EXPECT_EQ(after(who, brake, 4 * s), holder::godwit);
  EXPECT_EQ(after(who, brake, 10 * s), holder::person);
}

// Seen on a real rover, heard throughout.
TEST(control_authority, a_hold_whose_order_was_not_acknowledged_is_uncertain_until_an_operator_commands_it) {
  auto who = in_flight();
  who.expect({brake.custom_mode}, 0, 5 * s);
  who.on_mode(copter, brake, false, s);
  EXPECT_TRUE(who.is_ours());
  EXPECT_TRUE(who.is_uncertain());
  auto answered_late = who;
  answered_late.acknowledge();
  EXPECT_FALSE(answered_late.is_uncertain());
  who.confirm_hold();
  EXPECT_FALSE(who.is_uncertain());
}

TEST(control_authority, a_hold_whose_order_was_acknowledged_is_certain_and_so_is_what_no_hold_is) {
  auto who = in_flight();
  who.expect({brake.custom_mode}, 0, 5 * s);
  who.acknowledge();
  who.on_mode(copter, brake, false, s);
  EXPECT_FALSE(who.is_uncertain());
  who.expect({automatic.custom_mode}, 2 * s, 7 * s);
  who.on_mode(copter, automatic, false, 3 * s);
  EXPECT_FALSE(who.is_uncertain());
}

TEST(control_authority, an_acknowledgement_counts_for_its_own_order_alone) {
  auto who = in_flight();
  who.expect({automatic.custom_mode}, 0, 5 * s);
  who.acknowledge();
  who.expect_also({brake.custom_mode}, s, 6 * s);
  who.on_mode(copter, brake, false, 2 * s);
  EXPECT_TRUE(who.is_uncertain());
}

TEST(control_authority, an_order_that_has_expired_before_a_silence_is_not_expected_after_it) {
  auto who = in_flight();
  constexpr flight_mode goes_home{mode_kind::returning, 6};
  who.expect({goes_home.custom_mode}, 0, 5 * s);
  for (int beat = 1; beat <= 5; ++beat)
    who.on_heartbeat(beat * s);
  EXPECT_EQ(after(who, goes_home, 40 * s), holder::person);
}

TEST(control_authority, an_order_that_has_expired_does_not_come_back_with_the_next_one) {
  auto who = in_flight();
  who.expect_also({loiter.custom_mode}, 0, 5 * s);
  for (int beat = 1; beat <= 5; ++beat)
    who.on_heartbeat(beat * s);
  who.expect_also({brake.custom_mode}, 6 * s, 11 * s);
  EXPECT_EQ(after(who, loiter, 7 * s), holder::person);
  EXPECT_EQ(after(who, brake, 7 * s), holder::godwit);
}

TEST(control_authority, what_was_not_sent_is_not_expected) {
  auto who = in_flight();
  who.expect({brake.custom_mode}, 0, 5 * s);
  who.withdraw({brake.custom_mode});
  EXPECT_EQ(after(who, brake, s), holder::person);
}

// Of a real ArduPlane with RTL_AUTOLAND 2: RTL, 10 ms later AUTO, 1 ms later the text.
class plane_called_home : public testing::Test {
protected:
  static constexpr std::int64_t ms = s / 1000;
  static constexpr mode_owner plane{io::mavlink::mav_autopilot::ardupilotmega, vehicle_class::fixed_wing};
  static constexpr flight_mode mission_mode{mode_kind::mission, 10};
  static constexpr flight_mode rtl{mode_kind::returning, 11};
  static constexpr const char* lands = "Landing sequence start";

  plane_called_home() {
    who.begin(mission_mode);
    who.expect({rtl.custom_mode}, 0, 5 * s);
    who.on_mode(plane, rtl, false, s);
  }

  control_authority who;
};

TEST_F(plane_called_home, that_goes_on_with_the_landing_of_its_plan_and_says_so_is_still_ours) {
  who.on_mode(plane, mission_mode, false, s + 10 * ms);
  EXPECT_TRUE(who.is_unclear()) << "nothing is sent before it says so";
  who.on_text(plane, lands, s + 11 * ms);
  EXPECT_EQ(who.who(), holder::godwit);
  EXPECT_FALSE(who.is_unclear());
}

TEST_F(plane_called_home, whose_text_comes_before_its_mode_is_still_ours) {
  who.on_text(plane, lands, s + 9 * ms);
  who.on_mode(plane, mission_mode, false, s + 10 * ms);
  EXPECT_EQ(who.who(), holder::godwit);
  EXPECT_FALSE(who.is_unclear());
}

TEST_F(plane_called_home, that_is_put_into_its_mission_mode_without_a_word_is_a_persons) {
  who.on_mode(plane, mission_mode, false, s + 250 * ms);
  who.on_time(s + 450 * ms);
  EXPECT_TRUE(who.is_unclear());
  who.on_time(s + 451 * ms);
  EXPECT_EQ(who.who(), holder::person);
}

TEST_F(plane_called_home, that_is_landed_later_is_a_persons_who_has_said_so) {
  who.on_mode(plane, mission_mode, false, s + 301 * ms);
  who.on_text(plane, lands, s + 302 * ms);
  EXPECT_EQ(who.who(), holder::person);
}

TEST_F(plane_called_home, that_takes_another_mode_in_that_moment_is_a_persons) {
  who.on_mode(plane, mission_mode, false, s + 10 * ms);
  who.on_mode(plane, flight_mode{mode_kind::manual, 5}, false, s + 20 * ms);
  who.on_text(plane, lands, s + 21 * ms);
  EXPECT_EQ(who.who(), holder::person);
}

TEST_F(plane_called_home, by_a_person_is_that_persons_where_it_lands_as_well) {
  control_authority theirs;
  theirs.begin(mission_mode);
  theirs.on_mode(plane, rtl, false, s);
  theirs.on_mode(plane, mission_mode, false, s + 10 * ms);
  theirs.on_text(plane, lands, s + 11 * ms);
  EXPECT_EQ(theirs.who(), holder::person);
}

TEST(control_authority, a_person_who_puts_the_mode_back_still_has_it) {
  auto who = in_flight();
  who.on_mode(copter, loiter, false, 0);
  who.expect({automatic.custom_mode}, 0, 5 * s);
  who.on_mode(copter, automatic, false, s);
  EXPECT_EQ(who.who(), holder::person);
  who.begin(automatic);
  EXPECT_EQ(who.who(), holder::godwit);
}

TEST(control_authority, a_change_while_the_autopilot_is_critical_is_its_own) {
  auto who = in_flight();
  who.on_mode(copter, loiter, true, 0);
  EXPECT_EQ(who.who(), holder::autopilot_failsafe);
}

TEST(control_authority, a_change_that_an_ardupilot_calls_its_failsafes_is_its_own_whichever_comes_first) {
  auto text_first = in_flight();
  text_first.on_text(copter, "GCS Failsafe", s);
  text_first.on_mode(copter, loiter, false, 4 * s);
  EXPECT_EQ(text_first.who(), holder::autopilot_failsafe);
  auto mode_first = in_flight();
  mode_first.on_mode(copter, loiter, false, s);
  EXPECT_EQ(mode_first.who(), holder::person);
  mode_first.on_text(copter, "EKF Failsafe: changed to LAND Mode", 4 * s);
  EXPECT_EQ(mode_first.who(), holder::autopilot_failsafe);
}

TEST(control_authority, the_words_of_a_failsafe_count_for_three_seconds) {
  auto text_first = in_flight();
  text_first.on_text(copter, "GCS Failsafe", s);
  text_first.on_mode(copter, loiter, false, 4 * s + 1);
  EXPECT_EQ(text_first.who(), holder::person);
  auto mode_first = in_flight();
  mode_first.on_mode(copter, loiter, false, s);
  mode_first.on_text(copter, "GCS Failsafe", 4 * s + 1);
  EXPECT_EQ(mode_first.who(), holder::person);
}

TEST(control_authority, words_of_a_failsafe_never_give_or_take_the_vehicle) {
  auto who = in_flight();
  who.on_text(copter, "EKF Failsafe: changed to LAND Mode", s);
  EXPECT_EQ(who.who(), holder::godwit) << "the mode decides";
  who.on_mode(copter, stabilize, false, 2 * s);
  ASSERT_EQ(who.who(), holder::autopilot_failsafe);
  who.on_mode(copter, automatic, false, 3 * s);
  EXPECT_EQ(who.who(), holder::autopilot_failsafe);
}

TEST(control_authority, other_words_and_those_of_another_autopilot_explain_nothing) {
  for (const auto* each : {"GCS Failsafe Cleared", "Radio Failsafe - Continuing Auto Mode", "Mission: 3 WP"}) {
    auto who = in_flight();
    who.on_text(copter, each, 0);
    EXPECT_EQ(after(who, loiter), holder::person) << each;
  }
  auto who = in_flight();
  who.on_text(px4, "GCS Failsafe", 0);
  EXPECT_EQ(after(who, loiter), holder::person);
}

TEST(control_authority, who_was_said_to_have_taken_it_by_somebody_else_is_no_failsafe) {
  auto who = in_flight();
  who.take_away(holder::person);
  who.on_text(copter, "GCS Failsafe", s);
  EXPECT_EQ(who.who(), holder::person);
}

TEST(control_authority, the_words_of_a_failsafe_before_a_hand_back_explain_nothing_after_it) {
  auto who = in_flight();
  who.on_text(copter, "GCS Failsafe", 0);
  who.begin(automatic);
  EXPECT_EQ(after(who, loiter, s), holder::person);
}

TEST(control_authority, on_the_way_to_the_last_item_a_hold_is_a_persons) {
  auto who = near_its_end();
  who.on_place(last_item, false, 0);
  who.on_mode(px4, px4_hold, false, s);
  EXPECT_TRUE(who.is_unclear()) << "the word that the plan is done may be on its way";
  who.on_place(last_item, false, 2 * s);
  EXPECT_EQ(who.who(), holder::person);
}

TEST(control_authority, after_the_last_item_the_hold_into_which_the_plan_leads_is_nobodys_takeover) {
  auto who = near_its_end();
  who.on_mode(px4, px4_hold, false, s);
  who.on_place(last_item, true, s + s / 10);
  EXPECT_EQ(who.who(), holder::autopilot_end);
  EXPECT_FALSE(who.is_unclear());
}

// CURRENT_MODE (hold, mission intended) came in the millisecond of MISSION_CURRENT, in either order.
TEST(control_authority, a_hold_that_nobody_has_asked_for_when_the_plan_is_complete_is_its_end) {
  for (const bool is_place_first : {true, false}) {
    auto who = near_its_end();
    who.on_current_mode(px4, {px4_mission, false, px4_mission.custom_mode}, 0);
    who.on_place(last_item, false, 0);
    if (is_place_first)
      who.on_place(last_item, true, 2 * s);
    who.on_current_mode(px4, {px4_hold, false, px4_mission.custom_mode}, 2 * s);
    if (!is_place_first) {
      EXPECT_TRUE(who.is_unclear());
      who.on_place(last_item, true, 2 * s);
    }
    EXPECT_EQ(who.who(), holder::autopilot_end) << is_place_first;
    EXPECT_FALSE(who.is_unclear());
  }
}

TEST(control_authority, a_hold_that_nobody_has_asked_for_is_a_failsafes_while_the_plan_is_not_complete) {
  auto early = near_its_end();
  early.on_current_mode(px4, {px4_mission, false, px4_mission.custom_mode}, 0);
  auto late = early;
  early.on_place(last_item - 1, false, 0);
  early.on_current_mode(px4, {px4_hold, false, px4_mission.custom_mode}, 1);
  EXPECT_EQ(early.who(), holder::autopilot_failsafe) << "it is not at its end yet";
  late.on_place(last_item, false, 0);
  late.on_current_mode(px4, {px4_hold, false, px4_mission.custom_mode}, 1);
  EXPECT_TRUE(late.is_unclear());
  late.on_place(last_item, false, s);
  EXPECT_EQ(late.who(), holder::autopilot_failsafe);
}

TEST(control_authority, the_words_of_a_breached_fence_count_for_what_changes_in_that_moment) {
  for (const auto told_ns : {s - s / 10, s + s / 10}) {
    auto who = in_flight();
    if (told_ns < s)
      who.on_text(copter, "Circle fence breached", told_ns);
    who.on_mode(copter, loiter, false, s);
    if (told_ns > s)
      who.on_text(copter, "Circle fence breached", told_ns);
    EXPECT_EQ(who.who(), holder::autopilot_failsafe) << told_ns;
  }
  auto heard = in_flight();
  heard.on_text(copter, "Circle fence breached", s);
  heard.on_mode(copter, loiter, false, s + s / 2);
  EXPECT_EQ(heard.who(), holder::person);
}

TEST(control_authority, a_plan_leads_there_once) {
  auto who = near_its_end();
  who.on_place(last_item, true, 0);
  who.on_mode(px4, px4_hold, false, s);
  who.expect({px4_mission.custom_mode}, 0, 10 * s);
  who.on_mode(px4, px4_mission, false, 2 * s);
  EXPECT_EQ(who.who(), holder::godwit);
  who.on_mode(px4, px4_hold, false, 4 * s);
  EXPECT_EQ(who.who(), holder::person);
}

TEST(control_authority, where_the_end_is_not_told_in_time_it_is_a_person) {
  auto who = near_its_end();
  who.on_mode(px4, px4_hold, false, s);
  who.on_time(s + end_is_told_within_ns - 1);
  EXPECT_TRUE(who.is_unclear());
  who.on_time(s + end_is_told_within_ns);
  EXPECT_EQ(who.who(), holder::person);
}

TEST(control_authority, who_leaves_the_end_and_comes_back_has_touched_it) {
  auto who = near_its_end();
  who.on_mode(px4, px4_hold, false, s);
  who.on_mode(px4, px4_mission, false, s + s / 2);
  EXPECT_EQ(who.who(), holder::person);
}

TEST(control_authority, what_was_said_of_the_plan_before_ends_no_plan) {
  auto who = near_its_end();
  who.on_place(last_item, true, 0);
  who.set_plan_end({last_item, false, {px4_hold.custom_mode}});
  who.on_mode(px4, px4_hold, false, s);
  EXPECT_TRUE(who.is_unclear());
}

TEST(control_authority, an_incarnation_that_begins_anew_knows_where_the_one_before_left_it) {
  control_authority who;
  who.resume({automatic.custom_mode, brake.custom_mode}, 0);
  EXPECT_EQ(after(who, automatic), holder::godwit);
  EXPECT_EQ(after(who, brake), holder::godwit);
  EXPECT_EQ(after(who, loiter), holder::person);
  for (int beat = 0; beat < 5; ++beat)
    who.on_mode(copter, automatic, false, beat * s);
  EXPECT_EQ(after(who, brake, order_is_expected_ns), holder::person) << "whatever was under way has come by then";
}

// -- what a change leaves behind ----------------------------------------------------------------------

TEST(control_authority, the_words_of_a_breach_before_a_hand_back_explain_nothing_after_it) {
  auto who = in_flight();
  who.on_text(copter, "Circle fence breached", 0);
  who.begin(automatic);
  EXPECT_EQ(after(who, loiter, s / 10), holder::person);
}

TEST(control_authority, orders_before_the_one_that_is_obeyed_are_expected_no_more) {
  auto begun = in_flight();
  begun.expect({brake.custom_mode, automatic.custom_mode}, 0, 5 * s);
  auto obeyed = begun;
  begun.begin(automatic);
  EXPECT_EQ(after(begun, brake, s), holder::person);
  obeyed.on_mode(copter, brake, false, s);
  obeyed.on_mode(copter, automatic, false, 2 * s);
  ASSERT_EQ(obeyed.who(), holder::godwit);
  EXPECT_EQ(after(obeyed, brake, 3 * s), holder::person);
}

TEST(control_authority, a_return_that_was_found_and_not_ordered_does_not_end_in_a_hold_by_itself) {
  constexpr mode_owner by_the_text{mav_autopilot::generic, vehicle_class::rover};
  constexpr flight_mode returns{mode_kind::returning, 11};
  constexpr flight_mode holds{mode_kind::hold, 4};
  auto who = in_flight();
  who.expect({returns.custom_mode}, 0, 5 * s);
  who.on_mode(by_the_text, returns, false, s);
  auto found = who;
  who.on_mode(by_the_text, holds, false, 2 * s);
  EXPECT_EQ(who.who(), holder::godwit);
  found.begin(returns);
  found.on_mode(by_the_text, holds, false, 2 * s);
  EXPECT_EQ(found.who(), holder::person);
}

TEST(control_authority, what_waits_for_a_heartbeat_waits_for_the_next_one_and_not_after_a_takeover_or_a_hand_back) {
  auto waits = in_flight(px4_mission);
  waits.on_current_mode(px4, {px4_hold, false, 0}, s);
  ASSERT_TRUE(waits.is_unclear());
  auto heard = waits;
  heard.on_mode(px4, px4_mission, false, 2 * s);
  EXPECT_FALSE(heard.is_unclear());
  EXPECT_EQ(heard.who(), holder::godwit);
  auto taken = waits;
  taken.take_away(holder::person);
  EXPECT_FALSE(taken.is_unclear());
  waits.begin(px4_hold);
  EXPECT_FALSE(waits.is_unclear());
}

TEST(control_authority, who_was_seen_and_then_told_to_have_taken_it_is_no_failsafe) {
  auto who = in_flight();
  who.on_mode(copter, loiter, false, s);
  who.take_away(holder::person);
  who.on_text(copter, "GCS Failsafe", 2 * s);
  EXPECT_EQ(who.who(), holder::person);
}

TEST(control_authority, a_place_that_the_vehicle_does_not_know_is_no_end_of_the_plan) {
  auto who = near_its_end();
  who.on_place(65'535, true, 0);
  who.on_mode(px4, px4_hold, false, s);
  EXPECT_TRUE(who.is_unclear());
}

TEST(control_authority, at_its_last_item_only_the_mode_into_which_the_plan_leads_is_unclear) {
  constexpr flight_mode px4_returns{mode_kind::returning, 4U << 16U | 5U << 24U};
  auto who = near_its_end();
  who.on_current_mode(px4, {px4_mission, false, px4_mission.custom_mode}, 0);
  who.on_place(last_item, false, 0);
  who.on_current_mode(px4, {px4_returns, false, px4_mission.custom_mode}, s);
  EXPECT_FALSE(who.is_unclear());
  EXPECT_EQ(who.who(), holder::autopilot_failsafe);
}

TEST(control_authority, at_the_end_of_the_plan_nothing_is_expected_any_more) {
  auto who = near_its_end();
  who.expect({px4_mission.custom_mode}, 0, 10 * s);
  who.on_place(last_item, true, 0);
  who.on_mode(px4, px4_hold, false, s);
  ASSERT_EQ(who.who(), holder::autopilot_end);
  who.on_mode(px4, px4_mission, false, 2 * s);
  EXPECT_EQ(who.who(), holder::person);
}

TEST(control_authority, a_word_half_a_second_after_the_mode_denies_the_end_and_an_earlier_one_may_have_crossed_it) {
  for (const auto after_ns : {end_is_denied_after_ns - 1, end_is_denied_after_ns}) {
    auto who = near_its_end();
    who.on_mode(px4, px4_hold, false, s);
    who.on_place(last_item, false, s + after_ns);
    EXPECT_EQ(who.is_unclear(), after_ns < end_is_denied_after_ns);
  }
}

TEST(control_authority, a_takeover_settles_what_was_unclear) {
  auto who = near_its_end();
  who.on_mode(px4, px4_hold, false, s);
  ASSERT_TRUE(who.is_unclear());
  who.take_away(holder::person);
  EXPECT_FALSE(who.is_unclear());
}

} // namespace control_authority_test
} // namespace godwit::flight
