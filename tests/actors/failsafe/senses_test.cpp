#include <gtest/gtest.h>

#include "actors/failsafe/senses.hpp"
#include "io/mavlink/enums.hpp"

namespace {

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
  const auto stands = sense(mavlink::heartbeat{.type = mavlink::number(mavlink::mav_type::ground_rover),
                                               .autopilot = mavlink::number(mavlink::mav_autopilot::ardupilotmega),
                                               .base_mode = 1,
                                               .custom_mode = 99});
  EXPECT_FALSE(stands.armed);
  EXPECT_EQ(stands.mode, (flight_mode{mode_kind::unknown, 99}));
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

TEST(senses, a_battery_of_which_the_autopilot_knows_nothing_is_minus_one) {
  EXPECT_EQ(sense(mavlink::sys_status{.battery_remaining = -1}).percent, -1);
  EXPECT_EQ(sense(mavlink::sys_status{.battery_remaining = 15}).percent, 15);
}

} // namespace
