#include <vector>

#include <gtest/gtest.h>

#include "actors/failsafe/first_look.hpp"
#include "io/mavlink/enums.hpp"

namespace first_look_test {

using namespace godwit::failsafe;
namespace mavlink = godwit::io::mavlink;

TEST(first_look, it_asks_for_who_the_vehicle_is_first_and_for_one_message_at_a_time) {
  first_look look;
  look.begin();
  EXPECT_EQ(look.next(true), mavlink::heartbeat::message_id);
  EXPECT_FALSE(look.next(true));
  look.heard(mavlink::heartbeat::message_id);
  look.resolved();
  EXPECT_EQ(look.next(true), mavlink::extended_sys_state::message_id);
}

TEST(first_look, what_came_by_itself_is_not_asked_for) {
  first_look look;
  look.begin();
  look.heard(mavlink::heartbeat::message_id);
  look.heard(mavlink::extended_sys_state::message_id);
  look.heard(mavlink::sys_status::message_id);
  EXPECT_EQ(look.next(true), mavlink::global_position_int::message_id);
}

TEST(first_look, a_vehicle_that_does_not_answer_is_left_to_its_streams) {
  first_look look;
  look.begin();
  int asked = 0;
  while (look.next(true)) {
    ++asked;
    look.resolved();
  }
  EXPECT_EQ(asked, 5 * max_look_tries);
}

TEST(first_look, before_it_begins_and_after_all_was_heard_it_asks_for_nothing) {
  first_look look;
  EXPECT_FALSE(look.next(true));
  look.begin();
  for (const auto id : {mavlink::heartbeat::message_id, mavlink::extended_sys_state::message_id,
                        mavlink::global_position_int::message_id, mavlink::global_position_int::message_id,
                        mavlink::sys_status::message_id, mavlink::home_position::message_id})
    look.heard(id);
  EXPECT_FALSE(look.next(true));
}

TEST(first_look, one_position_proves_nothing_and_a_second_is_asked_for) {
  first_look look;
  look.begin();
  for (const auto id : {mavlink::heartbeat::message_id, mavlink::extended_sys_state::message_id,
                        mavlink::sys_status::message_id, mavlink::home_position::message_id})
    look.heard(id);
  EXPECT_EQ(look.next(true), mavlink::global_position_int::message_id);
  look.heard(mavlink::global_position_int::message_id);
  look.resolved();
  EXPECT_FALSE(look.next(false)); // it would say the same again
  EXPECT_EQ(look.next(true), mavlink::global_position_int::message_id);
  look.heard(mavlink::global_position_int::message_id);
  look.resolved();
  EXPECT_FALSE(look.next(true));
}

} // namespace first_look_test

namespace senses_test {

using namespace godwit::failsafe;

namespace mavlink = godwit::io::mavlink;

TEST(senses, a_heartbeat_says_what_it_is_whether_it_is_armed_and_in_which_mode) {
  const auto flies = sense(mavlink::heartbeat{.type = mavlink::number(mavlink::mav_type::fixed_wing),
                                              .autopilot = mavlink::number(mavlink::mav_autopilot::px4),
                                              .base_mode = 128 | 1,
                                              .custom_mode = 4U << 16U | 5U << 24U});
  EXPECT_EQ(flies.what, vehicle_class::fixed_wing);
  EXPECT_TRUE(flies.armed);
  EXPECT_EQ(flies.mode.kind, mode_kind::returning);
  EXPECT_EQ(flies.autopilot, mavlink::mav_autopilot::px4);
  const auto stands = sense(mavlink::heartbeat{.type = mavlink::number(mavlink::mav_type::ground_rover),
                                               .autopilot = mavlink::number(mavlink::mav_autopilot::ardupilotmega),
                                               .base_mode = 1,
                                               .custom_mode = 99});
  EXPECT_FALSE(stands.armed);
  EXPECT_EQ(stands.mode, (flight_mode{mode_kind::unknown, 99}));
}

TEST(senses, a_heartbeat_says_whether_the_autopilot_thinks_that_something_is_wrong) {
  using mavlink::mav_state;
  for (const auto state : {mav_state::standby, mav_state::active, mav_state::critical, mav_state::emergency})
    EXPECT_EQ(sense(mavlink::heartbeat{.system_status = mavlink::number(state)}).is_critical,
              state == mav_state::critical);
}

TEST(senses, a_current_mode_says_the_mode_and_the_one_that_was_asked_for) {
  const auto told = sense(mavlink::current_mode{.custom_mode = 7, .intended_custom_mode = 9});
  EXPECT_EQ(told.actual, 7U);
  EXPECT_EQ(told.intended, 9U);
}

TEST(senses, the_landed_state_is_unknown_where_the_autopilot_does_not_know_it_or_says_a_new_one) {
  EXPECT_EQ(sense(mavlink::extended_sys_state{.landed_state = 0}).how, landed_state::unknown);
  EXPECT_EQ(sense(mavlink::extended_sys_state{.landed_state = 1}).how, landed_state::on_ground);
  EXPECT_EQ(sense(mavlink::extended_sys_state{.landed_state = 2}).how, landed_state::in_air);
  EXPECT_EQ(sense(mavlink::extended_sys_state{.landed_state = 3}).how, landed_state::taking_off);
  EXPECT_EQ(sense(mavlink::extended_sys_state{.landed_state = 4}).how, landed_state::landing);
  EXPECT_EQ(sense(mavlink::extended_sys_state{.landed_state = 77}).how, landed_state::unknown);
}

TEST(senses, a_position_is_in_degrees_metres_above_home_and_metres_a_second) {
  const auto there = sense(mavlink::global_position_int{
      .lat = 473977420, .lon = -85455940, .alt = 500'000, .relative_alt = 50'500, .vx = 120, .vy = -250, .vz = 30});
  EXPECT_DOUBLE_EQ(there.latitude_deg, 47.397742);
  EXPECT_DOUBLE_EQ(there.longitude_deg, -8.545594);
  EXPECT_DOUBLE_EQ(there.altitude_m, 50.5);
  EXPECT_DOUBLE_EQ(there.north_mps, 1.2);
  EXPECT_DOUBLE_EQ(there.east_mps, -2.5);
  EXPECT_DOUBLE_EQ(there.down_mps, 0.3);
}

TEST(senses, what_the_autopilot_says_is_its_text_up_to_the_end) {
  EXPECT_EQ(sense(mavlink::statustext{.text = {'E', 'K', 'F', '\0', 'x'}}).what, "EKF");
}

TEST(senses, a_battery_of_which_the_autopilot_knows_nothing_is_minus_one) {
  EXPECT_EQ(sense(mavlink::sys_status{.battery_remaining = -1}).percent, -1);
  EXPECT_EQ(sense(mavlink::sys_status{.battery_remaining = 15}).percent, 15);
}

TEST(senses, where_the_vehicle_is_in_its_plan_and_whether_that_is_complete) {
  using mavlink::mission_state;
  for (const auto state :
       {mission_state::unknown, mission_state::active, mission_state::paused, mission_state::complete}) {
    const auto there = sense(mavlink::mission_current{.seq = 6, .mission_state = mavlink::number(state)});
    EXPECT_EQ(there.sequence, 6);
    EXPECT_EQ(there.is_complete, state == mission_state::complete);
  }
}

} // namespace senses_test
