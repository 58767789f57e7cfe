#include "programs/godwit-sim/vehicle/autopilot/copter.hpp"

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include "io/mavlink/messages/request_data_stream.hpp"
#include "tests/programs/godwit-sim/vehicle/vehicle_world.hpp"

namespace godwit::sim::test {
namespace copter_test {

constexpr float automatic = 3;
constexpr float guided = 4;
constexpr float copter_loiter = 5;

class copter_with : public vehicle_world {
public:
  explicit copter_with(int waypoints) : vehicle_world(personality::ardupilot) {
    run_for(6 * s);
    const auto uploaded = waypoints > 0 ? upload(flight(waypoints)) : mav_mission_result::accepted;
    EXPECT_EQ(uploaded, mav_mission_result::accepted);
    run_for(2 * s);
    mark();
  }
  // Home, take-off, waypoints, landing.
  [[nodiscard]] plan flight(int waypoints) const { return flight_of(waypoints, home(), personality::ardupilot); }
  std::optional<mav_result> start(float first = 0, float last = 0) {
    return command(mav_cmd::mission_start, {.p1 = first, .p2 = last});
  }
  std::optional<mav_result> mode(float custom) { return command(mav_cmd::do_set_mode, {.p1 = 1, .p2 = custom}); }
  std::optional<mav_result> arm() { return command(mav_cmd::component_arm_disarm, {.p1 = 1}); }
  std::optional<mav_result> disarm() { return command(mav_cmd::component_arm_disarm); }
  [[nodiscard]] mavlink::mission_current current() {
    run_for(1 * s);
    return *last<mavlink::mission_current>();
  }
  // In the air, on the way to item SEQUENCE.
  [[nodiscard]] bool fly_to(int sequence) {
    return mode(guided) == mav_result::accepted && arm() == mav_result::accepted && start() == mav_result::accepted &&
           run_until([&] { return picture().mission_current == sequence; }, 200 * s);
  }
};

TEST(copter, keeps_home_as_item_0_and_does_not_count_it) {
  copter_with world(2);
  const auto back = world.download();
  ASSERT_TRUE(back);
  ASSERT_EQ(back->size(), 5U);
  EXPECT_EQ(back->front().command, mavlink::number(mav_cmd::nav_waypoint));
  EXPECT_EQ(back->front().frame, 0);
  EXPECT_NEAR(back->front().x, world.home().latitude_deg * 1e7, 1);
  EXPECT_NEAR(back->front().z, world.home().altitude_m, 0.01);
  EXPECT_EQ(world.current().total, 4);
  EXPECT_EQ(world.current().seq, 0);
  EXPECT_EQ(world.current().mission_id, 0U);
}

TEST(copter, denies_mission_start_with_a_first_or_last_item) {
  copter_with world(2);
  EXPECT_EQ(world.start(1), mav_result::denied);
  EXPECT_EQ(world.start(0, 2), mav_result::denied);
  EXPECT_EQ(world.start(5, 2), mav_result::denied);
  EXPECT_EQ(world.start(std::numeric_limits<float>::quiet_NaN()), mav_result::denied);
}

TEST(copter, does_not_arm_on_mission_start) {
  copter_with world(2);
  EXPECT_EQ(world.start(), mav_result::accepted) << "which does not mean that it moves";
  world.run_for(5 * s);
  EXPECT_FALSE(world.picture().armed);
  EXPECT_EQ(world.picture().mission_state, "idle");
}

TEST(copter, takes_off_from_guided_on_the_ground_on_mission_start) {
  copter_with world(2);
  ASSERT_EQ(world.mode(guided), mav_result::accepted);
  ASSERT_EQ(world.arm(), mav_result::accepted);
  ASSERT_EQ(world.start(), mav_result::accepted);
  EXPECT_EQ(world.picture().mode, "AUTO");
  EXPECT_TRUE(world.run_until([&] { return world.picture().in_air; }, 10 * s));
}

TEST(copter, armed_on_the_ground_wants_a_mission_that_begins_with_a_take_off) {
  copter_with world(0);
  auto items = row_of(3, world.home());
  items.insert(items.begin(), items.front());
  ASSERT_EQ(world.upload(numbered(items)), mav_mission_result::accepted);
  ASSERT_EQ(world.mode(guided), mav_result::accepted);
  ASSERT_EQ(world.arm(), mav_result::accepted);
  EXPECT_EQ(world.start(), mav_result::failed);
  EXPECT_TRUE(world.said("Auto: Missing Takeoff Cmd"));
  EXPECT_TRUE(world.said("Mode change to AUTO failed: init failed"));
  EXPECT_EQ(world.picture().mode, "GUIDED");
}

TEST(copter, fails_to_start_a_mission_that_is_not_there) {
  copter_with world(0);
  ASSERT_EQ(world.mode(guided), mav_result::accepted);
  ASSERT_EQ(world.arm(), mav_result::accepted);
  EXPECT_EQ(world.start(), mav_result::failed);
}

TEST(copter, tells_each_reached_item_once) {
  copter_with world(3);
  ASSERT_TRUE(world.fly_to(1));
  ASSERT_TRUE(world.run_until([&] { return !world.picture().armed; }, 200 * s));
  EXPECT_EQ(world.reached(), (std::vector<int>{1, 2, 3, 4})) << "and nothing of its landing, as ArduCopter";
}

TEST(copter, tells_in_its_words_how_far_it_is) {
  copter_with world(1);
  ASSERT_TRUE(world.fly_to(1));
  ASSERT_TRUE(world.run_until([&] { return !world.picture().armed; }, 200 * s));
  world.run_for(10 * ms);
  EXPECT_EQ(world.texts(),
            (std::vector<std::string>{"Mission: 1 Takeoff", "Mission: 2 WP", "Reached command #2", "Mission: 3 Land"}));
}

// mode_auto.cpp: verify_land() disarms and returns false; disarming sets the mission back, and it goes on running.
TEST(copter, is_at_its_first_item_with_state_3_after_a_landing_has_ended_its_mission) {
  copter_with world(1);
  ASSERT_TRUE(world.fly_to(1));
  ASSERT_TRUE(world.run_until([&] { return !world.picture().armed; }, 200 * s));
  const auto said = world.current();
  EXPECT_EQ(said.seq, 1);
  EXPECT_EQ(said.mission_state, mavlink::number(mavlink::mission_state::active));
  EXPECT_EQ(said.mission_mode, 1);
}

TEST(copter, is_back_at_sequence_0_with_state_5_after_it_has_returned_and_disarmed) {
  copter_with world(0);
  ASSERT_EQ(world.upload(with_return(world.flight(1))), mav_mission_result::accepted);
  ASSERT_TRUE(world.fly_to(1));
  ASSERT_TRUE(world.run_until([&] { return !world.picture().armed; }, 200 * s));
  const auto said = world.current();
  EXPECT_EQ(said.seq, 0);
  EXPECT_EQ(said.mission_state, mavlink::number(mavlink::mission_state::complete));
  EXPECT_EQ(said.mission_mode, 1);
  EXPECT_EQ(said.total, 3);
}

TEST(copter, has_mission_mode_1_in_auto_and_0_in_other_modes) {
  copter_with world(1);
  EXPECT_EQ(world.current().mission_mode, 0);
  ASSERT_EQ(world.mode(automatic), mav_result::accepted);
  EXPECT_EQ(world.current().mission_mode, 1);
}

TEST(copter, tells_the_current_item_at_1_hz_or_as_asked_and_not_on_change) {
  copter_with world(3);
  world.mark();
  world.run_for(10 * s);
  EXPECT_EQ(world.each<mavlink::mission_current>().size(), 10U);
  ASSERT_EQ(world.command(mav_cmd::set_message_interval, {.p1 = 42, .p2 = 200'000}), mav_result::accepted);
  world.mark();
  world.run_for(10 * s);
  EXPECT_NEAR(static_cast<double>(world.each<mavlink::mission_current>().size()), 50, 1);
  ASSERT_EQ(world.command(mav_cmd::set_message_interval, {.p1 = 42}), mav_result::accepted);
  ASSERT_TRUE(world.fly_to(3));
  const auto before = world.last_ns<mavlink::mission_current>();
  const auto next = world.run_until([&] { return world.last_ns<mavlink::mission_current>() != before; }, 2 * s);
  EXPECT_TRUE(next);
  EXPECT_NEAR(static_cast<double>(world.now_ns() - before), 1e9, 1e7);
}

TEST(copter, refuses_to_clear_a_mission_that_it_flies) {
  copter_with world(3);
  ASSERT_TRUE(world.fly_to(2));
  EXPECT_EQ(world.clear(), mav_mission_result::error);
  EXPECT_EQ(world.picture().mission_count, 6);
  ASSERT_EQ(world.mode(copter_loiter), mav_result::accepted);
  EXPECT_EQ(world.clear(), mav_mission_result::accepted);
}

TEST(copter, cuts_a_running_mission_when_a_count_of_fewer_items_arrives) {
  copter_with world(3);
  ASSERT_TRUE(world.fly_to(3));
  world.send(mavlink::mission_count{.target_system = 1, .target_component = 1, .count = 3});
  world.run_for(10 * ms);
  EXPECT_EQ(world.picture().mission_state, "idle");
  const auto where = world.picture().where;
  world.run_for(20 * s);
  EXPECT_LT(between(where, world.picture().where).distance_m, 10) << "it stays about where it was";
  EXPECT_TRUE(world.picture().in_air);
  EXPECT_EQ(world.picture().mode, "AUTO");
}

TEST(copter, flies_a_new_mission_that_was_uploaded_while_it_held) {
  copter_with world(3);
  ASSERT_TRUE(world.fly_to(3));
  ASSERT_EQ(world.mode(copter_loiter), mav_result::accepted);
  ASSERT_EQ(world.upload(world.flight(5)), mav_mission_result::accepted);
  ASSERT_EQ(world.command(mav_cmd::do_set_mission_current, {.p1 = 4}), mav_result::accepted);
  EXPECT_EQ(world.current().seq, 4);
  EXPECT_EQ(world.current().total, 7);
  world.mark();
  ASSERT_EQ(world.mode(automatic), mav_result::accepted);
  ASSERT_TRUE(world.run_until([&] { return !world.picture().armed; }, 200 * s));
  EXPECT_EQ(world.reached(), (std::vector<int>{4, 5, 6}));
}

TEST(copter, stops_its_mission_when_it_leaves_auto_and_goes_on_when_it_comes_back) {
  copter_with world(3);
  ASSERT_TRUE(world.fly_to(3));
  ASSERT_EQ(world.mode(copter_loiter), mav_result::accepted);
  EXPECT_EQ(world.current().seq, 3);
  EXPECT_EQ(world.current().mission_state, mavlink::number(mavlink::mission_state::not_started));
  ASSERT_EQ(world.mode(automatic), mav_result::accepted);
  EXPECT_EQ(world.current().mission_state, mavlink::number(mavlink::mission_state::active));
  EXPECT_EQ(world.current().seq, 3);
}

TEST(copter, is_not_ready_before_its_time_and_shows_it_by_the_pre_arm_bit) {
  constexpr std::uint32_t pre_arm = 0x1000'0000;
  vehicle_world world(personality::ardupilot);
  ASSERT_TRUE(world.run_until([&] { return world.last<mavlink::sys_status>().has_value(); }, 2 * s));
  EXPECT_EQ(world.last<mavlink::sys_status>()->onboard_control_sensors_health & pre_arm, 0U);
  EXPECT_EQ(world.command(mav_cmd::component_arm_disarm, {.p1 = 1}), mav_result::failed);
  EXPECT_TRUE(world.said("Arm: Need Position Estimate"));
  world.run_for(6 * s);
  EXPECT_NE(world.last<mavlink::sys_status>()->onboard_control_sensors_health & pre_arm, 0U);
  EXPECT_EQ(world.command(mav_cmd::component_arm_disarm, {.p1 = 1}), mav_result::accepted);
}

// Its checks pass before its estimator knows where it is; it can not be armed in between.
TEST(copter, is_armed_when_its_estimator_knows_where_it_is_and_not_as_its_checks_pass) {
  vehicle_world world(personality::ardupilot);
  const auto knows_place = [&] {
    const auto& newest = world.last<mavlink::ekf_status_report>();
    return newest && (newest->flags & mavlink::estimator_pos_horiz_abs) != 0;
  };
  world.run_for(5'500'000'000);
  EXPECT_FALSE(knows_place());
  EXPECT_EQ(world.command(mav_cmd::component_arm_disarm, {.p1 = 1}), mav_result::failed);
  world.run_for(2 * s);
  EXPECT_TRUE(knows_place());
  EXPECT_EQ(world.command(mav_cmd::component_arm_disarm, {.p1 = 1}), mav_result::accepted);
}

TEST(copter, fails_to_change_to_a_mode_that_does_not_exist_and_says_so) {
  copter_with world(0);
  EXPECT_EQ(world.mode(99), mav_result::failed);
  EXPECT_TRUE(world.said("No such mode 99"));
}

TEST(copter, does_not_arm_in_auto) {
  copter_with world(1);
  ASSERT_EQ(world.mode(automatic), mav_result::accepted);
  EXPECT_EQ(world.arm(), mav_result::failed);
  EXPECT_TRUE(world.said("Arm: Mode not armable"));
}

TEST(copter, refuses_to_disarm_in_the_air_unless_it_is_forced) {
  copter_with world(2);
  ASSERT_TRUE(world.fly_to(2));
  EXPECT_EQ(world.disarm(), mav_result::failed);
  EXPECT_TRUE(world.picture().armed);
  EXPECT_EQ(world.command(mav_cmd::component_arm_disarm, {.p1 = 0, .p2 = 21196}), mav_result::accepted);
  EXPECT_FALSE(world.picture().armed);
  EXPECT_TRUE(world.run_until([&] { return !world.picture().in_air; }, 20 * s)) << "it falls";
}

// ArduCopter 4.7: MISSION_START at 46.62, ON_GROUND and STANDBY until 49.92; a DISARM 2.2 s after a start was accepted.
TEST(copter, stands_for_3_3_s_after_a_start_while_its_rotors_spin_up_and_can_be_disarmed_then) {
  copter_with world(2);
  ASSERT_EQ(world.mode(guided), mav_result::accepted);
  ASSERT_EQ(world.arm(), mav_result::accepted);
  ASSERT_EQ(world.start(), mav_result::accepted);
  world.run_for(3 * s);
  EXPECT_FALSE(world.picture().in_air);
  EXPECT_EQ(world.last<mavlink::heartbeat>()->system_status, mavlink::number(mavlink::mav_state::standby));
  EXPECT_EQ(world.disarm(), mav_result::accepted);
  ASSERT_EQ(world.mode(guided), mav_result::accepted);
  ASSERT_EQ(world.arm(), mav_result::accepted);
  ASSERT_EQ(world.start(), mav_result::accepted);
  world.run_for(4 * s);
  EXPECT_TRUE(world.picture().in_air);
  EXPECT_EQ(world.disarm(), mav_result::failed);
}

TEST(copter, held_while_its_rotors_spin_up_it_takes_off_when_it_is_in_auto_again) {
  copter_with world(2);
  ASSERT_EQ(world.mode(guided), mav_result::accepted);
  ASSERT_EQ(world.arm(), mav_result::accepted);
  ASSERT_EQ(world.start(), mav_result::accepted);
  world.run_for(1 * s);
  ASSERT_EQ(world.mode(copter_loiter), mav_result::accepted);
  world.run_for(1 * s);
  ASSERT_EQ(world.mode(automatic), mav_result::accepted);
  EXPECT_TRUE(world.run_until([&] { return world.picture().in_air; }, 5 * s));
}

TEST(copter, takes_reposition_as_command_int_alone) {
  copter_with world(0);
  EXPECT_EQ(world.command(mav_cmd::do_reposition, {.p1 = -1, .p2 = 1}), mav_result::unsupported);
  ASSERT_EQ(world.mode(guided), mav_result::accepted);
  ASSERT_EQ(world.arm(), mav_result::accepted);
  EXPECT_EQ(world.command(mav_cmd::nav_takeoff, {.p7 = 10}), mav_result::accepted);
  world.run_for(15 * s);
  const auto there = item_at(mav_cmd::nav_waypoint, world.home(), {0, 25, 0});
  EXPECT_EQ(world.command_int(mav_cmd::do_reposition,
                              {.frame = 6, .param1 = -1, .param2 = 1, .x = there.x, .y = there.y, .z = 10}),
            mav_result::accepted);
  world.run_for(20 * s);
  EXPECT_NEAR(between(world.picture().where, world.home()).distance_m, 25, 1);
}

TEST(copter, pauses_in_auto_where_it_is) {
  copter_with world(3);
  EXPECT_EQ(world.command(mav_cmd::do_pause_continue), mav_result::unsupported) << "on the ground";
  ASSERT_TRUE(world.fly_to(3));
  ASSERT_EQ(world.command(mav_cmd::do_pause_continue), mav_result::accepted);
  world.run_for(20 * s);
  EXPECT_EQ(world.current().seq, 3);
  EXPECT_EQ(world.picture().mode, "AUTO");
  ASSERT_EQ(world.command(mav_cmd::do_pause_continue, {.p1 = 1}), mav_result::accepted);
  EXPECT_TRUE(world.run_until([&] { return !world.picture().armed; }, 200 * s));
}

TEST(copter, takes_off_by_command_in_guided_alone_and_armed) {
  copter_with world(0);
  EXPECT_EQ(world.command(mav_cmd::nav_takeoff, {.p7 = 10}), mav_result::failed);
  ASSERT_EQ(world.mode(guided), mav_result::accepted);
  EXPECT_EQ(world.command(mav_cmd::nav_takeoff, {.p7 = 10}), mav_result::failed);
  ASSERT_EQ(world.arm(), mav_result::accepted);
  EXPECT_EQ(world.command(mav_cmd::nav_takeoff, {.p7 = 10}), mav_result::accepted);
  world.run_for(15 * s);
  EXPECT_NEAR(world.picture().where.altitude_m - world.home().altitude_m, 10, 0.5);
  EXPECT_EQ(world.command(mav_cmd::nav_land), mav_result::accepted);
  EXPECT_EQ(world.picture().mode, "LAND");
  EXPECT_TRUE(world.run_until([&] { return !world.picture().armed; }, 60 * s));
}

TEST(copter, comes_home_and_disarms) {
  copter_with world(3);
  ASSERT_TRUE(world.fly_to(3));
  ASSERT_EQ(world.command(mav_cmd::nav_return_to_launch), mav_result::accepted);
  ASSERT_TRUE(world.run_until([&] { return !world.picture().armed; }, 100 * s));
  EXPECT_LT(between(world.picture().where, world.home()).distance_m, 2);
}

TEST(copter, disarms_itself_when_it_does_not_take_off) {
  copter_with world(0);
  ASSERT_EQ(world.arm(), mav_result::accepted);
  world.run_for(11 * s);
  EXPECT_FALSE(world.picture().armed);
}

TEST(copter, streams_at_1_hz_until_it_is_asked_and_asks_for_the_time_every_10_s) {
  copter_with world(0);
  world.mark();
  world.run_for(20 * s);
  EXPECT_EQ(world.each<mavlink::global_position_int>().size(), 20U);
  EXPECT_EQ(world.each<mavlink::timesync>().size(), 2U);
  world.send(mavlink::request_data_stream{1, 1, 0, 4, 1});
  world.mark();
  world.run_for(20 * s);
  EXPECT_NEAR(static_cast<double>(world.each<mavlink::global_position_int>().size()), 80, 1);
  EXPECT_NEAR(static_cast<double>(world.each<mavlink::mission_current>().size()), 80, 1);
  ASSERT_EQ(world.command(mav_cmd::set_message_interval, {.p1 = 33, .p2 = 100'000}), mav_result::accepted);
  world.mark();
  world.run_for(20 * s);
  EXPECT_NEAR(static_cast<double>(world.each<mavlink::global_position_int>().size()), 200, 1);
}

TEST(copter, goes_on_telling_a_stale_position_and_lands_when_satellites_are_lost) {
  copter_with world(3);
  ASSERT_TRUE(world.fly_to(3));
  world.subject().lose_position(true, world.now_ns());
  EXPECT_EQ(world.picture().mode, "LAND");
  world.mark();
  world.run_for(3 * s);
  const auto told = world.each<mavlink::global_position_int>();
  ASSERT_GE(told.size(), 2U);
  EXPECT_EQ(told.front().lat, told.back().lat);
  EXPECT_EQ(world.last<mavlink::gps_raw_int>()->fix_type, 1);
  EXPECT_TRUE(world.run_until([&] { return !world.picture().armed; }, 60 * s));
}

TEST(copter, lands_with_an_empty_battery) {
  copter_with world(3);
  ASSERT_TRUE(world.fly_to(3));
  world.subject().set_battery(0, world.now_ns());
  EXPECT_EQ(world.picture().mode, "LAND");
  EXPECT_TRUE(world.run_until([&] { return !world.picture().armed; }, 60 * s));
}

TEST(copter, holds_what_there_is_of_a_plan_whose_upload_broke_off) {
  copter_with world(3);
  world.send(mavlink::mission_count{.target_system = 1, .target_component = 1, .count = 3});
  world.run_for(12 * s);
  EXPECT_TRUE(world.said("Mission upload timeout"));
  const auto back = world.download();
  ASSERT_TRUE(back);
  EXPECT_EQ(static_cast<int>(back->size()), world.picture().mission_count) << "what flies is what is held";
}

TEST(copter, greets_who_asks_for_all_parameters) {
  copter_with world(0);
  world.send(mavlink::param_request_list{1, 1});
  world.run_for(1 * s);
  EXPECT_TRUE(world.said("ArduCopter V4.7.0-dev (99ea60eb)"));
  const auto values = world.each<mavlink::param_value>();
  ASSERT_FALSE(values.empty());
  EXPECT_EQ(values.size(), values.front().param_count);
}

} // namespace copter_test
} // namespace godwit::sim::test
