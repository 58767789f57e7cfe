#include "actors/domain/control_authority/mode_tables.hpp"

#include <gtest/gtest.h>

#include "io/mavlink/enums.hpp"
#include "tests/actors/domain/control_authority/vehicles.hpp"

namespace godwit::flight {
namespace mode_tables_test {

using io::mavlink::mav_autopilot;
using io::mavlink::mav_cmd;
using io::mavlink::number;
using modes = std::vector<std::uint32_t>;

using tests::copter;
constexpr mode_owner plane{mav_autopilot::ardupilotmega, vehicle_class::fixed_wing};
constexpr mode_owner rover{mav_autopilot::ardupilotmega, vehicle_class::rover};
using tests::px4;
constexpr mode_owner by_the_text{mav_autopilot::generic, vehicle_class::rover};
constexpr std::uint32_t px4_hold_number = 4U << 16U | 3U << 24U;
constexpr std::uint32_t px4_return = 4U << 16U | 5U << 24U;

plan_end end_of(const mode_owner& whose, mav_cmd last) { return plan_end_of(whose, number(last), 7); }

TEST(mode_tables, an_ardupilot_copter_and_rover_stay_in_auto_after_any_last_item) {
  for (const auto& whose : {copter, rover})
    for (const auto last : {mav_cmd::nav_waypoint, mav_cmd::nav_land, mav_cmd::nav_return_to_launch})
      EXPECT_EQ(end_of(whose, last).modes, modes());
}

TEST(mode_tables, a_plane_returns_as_its_return_begins_and_when_another_plan_is_done) {
  const modes returns{11, 21, 20}; // RTL, QRTL, QLAND
  EXPECT_EQ(end_of(plane, mav_cmd::nav_return_to_launch), (plan_end{7, true, returns}));
  EXPECT_EQ(end_of(plane, mav_cmd::nav_waypoint), (plan_end{7, false, returns}));
  EXPECT_EQ(end_of(plane, mav_cmd::nav_land).modes, modes());
}

TEST(mode_tables, a_px4_returns_as_its_return_begins_and_holds_when_another_plan_is_done) {
  EXPECT_EQ(end_of(px4, mav_cmd::nav_return_to_launch), (plan_end{7, true, {px4_return}}));
  EXPECT_EQ(end_of(px4, mav_cmd::nav_waypoint), (plan_end{7, false, {px4_hold_number}}));
}

TEST(mode_tables, after_the_landing_of_a_px4_it_may_hold_until_it_is_disarmed) {
  EXPECT_EQ(end_of(px4, mav_cmd::nav_land), (plan_end{7, false, {px4_hold_number}}));
}

TEST(mode_tables, by_the_text_alone_a_vehicle_holds_when_its_plan_is_done) {
  EXPECT_EQ(end_of(by_the_text, mav_cmd::nav_waypoint), (plan_end{7, false, {4}}));
  EXPECT_EQ(end_of(by_the_text, mav_cmd::nav_return_to_launch).modes, modes());
}

TEST(mode_tables, an_order_is_obeyed_by_the_mode_that_it_names_alone) {
  EXPECT_EQ(modes_obeying(copter, mode_kind::hold), modes{17}); // BRAKE, and not LOITER
  EXPECT_EQ(modes_obeying(rover, mode_kind::hold), modes{4});
  EXPECT_EQ(modes_obeying(px4, mode_kind::hold), modes{px4_hold_number});
  EXPECT_EQ(modes_obeying(rover, mode_kind::landing), modes());
}

TEST(mode_tables, each_has_a_mode_in_which_it_stands) {
  EXPECT_EQ(standing_mode(copter), 5U); // LOITER: BRAKE is refused on the ground
  EXPECT_EQ(standing_mode(plane), 5U);  // FBWA
  EXPECT_EQ(standing_mode(rover), 4U);
  EXPECT_EQ(standing_mode(px4), px4_hold_number);
}

TEST(mode_tables, a_quad_plane_turns_its_return_into_qrtl_and_a_copter_does_not_turn_its_own_into_anything) {
  EXPECT_TRUE(follows_by_itself(plane, 11, 21, false));
  EXPECT_FALSE(follows_by_itself(plane, 21, 11, true));
  EXPECT_FALSE(follows_by_itself(copter, 6, 9, true));
  EXPECT_FALSE(follows_by_itself(px4, px4_return, px4_hold_number, true));
}

TEST(mode_tables, by_the_text_alone_a_return_that_we_ordered_may_end_in_a_hold) {
  EXPECT_TRUE(follows_by_itself(by_the_text, 11, 4, true));
  EXPECT_FALSE(follows_by_itself(by_the_text, 11, 4, false));
}

TEST(mode_tables, of_a_plane_only_a_return_may_be_obeyed_by_several_modes) {
  EXPECT_EQ(modes_obeying(plane, mode_kind::returning), (modes{11, 21, 20}));
  EXPECT_EQ(modes_obeying(plane, mode_kind::mission), modes{10});
}

TEST(mode_tables, landings_and_returns_lead_down) {
  for (const auto last : {mav_cmd::nav_land, mav_cmd::nav_vtol_land, mav_cmd::nav_return_to_launch})
    EXPECT_TRUE(leads_down(number(last)));
  EXPECT_FALSE(leads_down(number(mav_cmd::nav_waypoint)));
}

TEST(mode_tables, after_a_disarm_a_px4_may_hold_or_be_in_its_mission) {
  constexpr std::uint32_t px4_mission_number = 4U << 16U | 4U << 24U;
  EXPECT_TRUE(may_follow_disarm(px4, px4_mission_number));
  EXPECT_TRUE(may_follow_disarm(px4, px4_hold_number));
  EXPECT_FALSE(may_follow_disarm(px4, px4_return));
  EXPECT_FALSE(may_follow_disarm(copter, 3));
}

TEST(mode_tables, the_take_off_of_a_px4_ends_in_its_mission_or_in_a_hold) {
  constexpr std::uint32_t px4_take_off = 4U << 16U | 2U << 24U;
  EXPECT_TRUE(follows_by_itself(px4, px4_take_off, 4U << 16U | 4U << 24U, false));
  EXPECT_TRUE(follows_by_itself(px4, px4_take_off, px4_hold_number, false));
  EXPECT_FALSE(follows_by_itself(px4, px4_take_off, px4_return, false));
  EXPECT_FALSE(follows_by_itself(px4, px4_return, px4_hold_number, false));
}

} // namespace mode_tables_test
} // namespace godwit::flight
