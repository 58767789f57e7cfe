#include "programs/godwit-sim/vehicle/autopilot/rover.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "tests/programs/godwit-sim/vehicle/vehicle_world.hpp"

namespace godwit::sim::test {
namespace rover_test {

constexpr float hold = 4;
constexpr float rover_auto = 10;

// A rover with COUNT waypoints, armed in HOLD.
class rover_in : public vehicle_world {
public:
  explicit rover_in(int count, bool armed = true) : vehicle_world(personality::rover) {
    const auto uploaded = count > 0 ? upload(row_of(count, home())) : mav_mission_result::accepted;
    EXPECT_EQ(uploaded, mav_mission_result::accepted);
    EXPECT_TRUE(!armed || make_ready());
    run_for(2 * s);
    mark();
  }
  std::optional<mav_result> start(float first = 0, float last = 0) {
    return command(mav_cmd::mission_start, {.p1 = first, .p2 = last});
  }
  std::optional<mav_result> mode(float custom) { return command(mav_cmd::do_set_mode, {.p1 = 1, .p2 = custom}); }
  [[nodiscard]] int state() const { return last<mavlink::mission_current>()->mission_state; }
  void set_current(int seq) {
    send(mavlink::mission_set_current{vehicle_id.system, vehicle_id.component, static_cast<std::uint16_t>(seq)});
  }
};

// -- acceptance criteria ----------------------------------------------------------------------------

TEST(rover, FR_00089_mission_start_is_handled_in_either_message) {
  rover_in world(2);
  EXPECT_EQ(world.start(), mav_result::accepted);
  rover_in other(2);
  EXPECT_EQ(other.command_int(mav_cmd::mission_start, {}), mav_result::accepted);
  EXPECT_EQ(other.picture().mission_state, "running");
}

TEST(rover, FR_00089_mission_start_triggers_the_change_to_auto) {
  rover_in world(2);
  ASSERT_EQ(world.picture().mode, "HOLD");
  ASSERT_EQ(world.start(), mav_result::accepted);
  EXPECT_EQ(world.picture().mode, "AUTO");
  world.run_for(1 * s);
  EXPECT_EQ(world.last<mavlink::heartbeat>()->custom_mode, 10U);
}

TEST(rover, FR_00089_mission_start_of_an_empty_mission_fails) {
  rover_in world(0);
  EXPECT_EQ(world.start(), mav_result::failed);
  EXPECT_EQ(world.picture().mode, "HOLD");
}

TEST(rover, FR_00089_mission_start_sets_the_mission_running) {
  rover_in world(2);
  EXPECT_EQ(world.state(), mavlink::number(mavlink::mission_state::not_started));
  ASSERT_EQ(world.start(), mav_result::accepted);
  EXPECT_EQ(world.picture().mission_state, "running");
  world.run_for(100 * ms);
  EXPECT_EQ(world.state(), mavlink::number(mavlink::mission_state::active));
}

TEST(rover, FR_00089_mission_start_begins_at_the_first_waypoint) {
  rover_in world(3);
  ASSERT_EQ(world.start(), mav_result::accepted);
  EXPECT_EQ(world.picture().mission_current, 0);
  ASSERT_TRUE(world.run_until([&] { return world.picture().mission_state == "completed"; }, 100 * s));
  EXPECT_EQ(world.reached(), (std::vector<int>{0, 1, 2}));
}

TEST(rover, FR_00089_mission_start_begins_at_the_specified_index) {
  rover_in world(4);
  ASSERT_EQ(world.start(2), mav_result::accepted);
  EXPECT_EQ(world.picture().mission_current, 2);
  ASSERT_TRUE(world.run_until([&] { return world.picture().mission_state == "completed"; }, 100 * s));
  EXPECT_EQ(world.reached(), (std::vector<int>{2, 3}));
}

TEST(rover, FR_00089_mission_start_says_mission_started) {
  rover_in world(2);
  ASSERT_EQ(world.start(), mav_result::accepted);
  EXPECT_TRUE(world.said("Mission started"));
}

// -- risks ------------------------------------------------------------------------------------------

TEST(rover, FR_00089_mission_start_while_disarmed_is_denied) {
  rover_in world(2, false);
  EXPECT_EQ(world.start(), mav_result::denied);
  EXPECT_EQ(world.picture().mission_state, "idle");
  EXPECT_EQ(world.picture().mode, "HOLD");
}

TEST(rover, FR_00089_mission_start_arms_where_it_is_told_to) {
  vehicle_world world(vehicle_settings{.who = personality::rover, .arms_on_start = true});
  ASSERT_EQ(world.upload(row_of(2, world.home())), mav_mission_result::accepted);
  ASSERT_EQ(world.command(mav_cmd::mission_start), mav_result::accepted);
  EXPECT_TRUE(world.picture().armed);
  EXPECT_TRUE(world.run_until([&] { return world.picture().mission_state == "completed"; }, 100 * s));
}

TEST(rover, FR_00089_an_invalid_first_item_fails) {
  rover_in world(3);
  EXPECT_EQ(world.start(3), mav_result::failed);
  EXPECT_EQ(world.start(1'000), mav_result::failed);
  EXPECT_EQ(world.start(2), mav_result::accepted);
}

TEST(rover, FR_00089_a_start_during_navigation_restarts_at_the_new_index) {
  rover_in world(4);
  ASSERT_EQ(world.start(), mav_result::accepted);
  ASSERT_TRUE(world.run_until([&] { return world.picture().mission_current == 2; }, 60 * s));
  world.mark();
  ASSERT_EQ(world.start(1), mav_result::accepted);
  EXPECT_EQ(world.picture().mission_current, 1);
  ASSERT_TRUE(world.run_until([&] { return world.picture().mission_state == "completed"; }, 100 * s));
  EXPECT_EQ(world.reached(), (std::vector<int>{1, 2, 3}));
}

// -- the edges --------------------------------------------------------------------------------------

TEST(rover, FR_00089_a_last_item_before_the_first_is_denied) { EXPECT_EQ(rover_in(4).start(3, 2), mav_result::denied); }

TEST(rover, FR_00089_a_last_item_beyond_the_mission_is_denied) {
  EXPECT_EQ(rover_in(4).start(0, 4), mav_result::denied);
}

TEST(rover, FR_00089_a_last_item_ends_the_mission) {
  rover_in world(4);
  ASSERT_EQ(world.start(1, 2), mav_result::accepted);
  ASSERT_TRUE(world.run_until([&] { return world.picture().mission_state == "completed"; }, 100 * s));
  EXPECT_EQ(world.reached(), (std::vector<int>{1, 2}));
}

TEST(rover, FR_00089_a_number_that_is_no_sequence_is_denied) {
  for (const float each :
       {-1.0F, 1.5F, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    rover_in world(4);
    EXPECT_EQ(world.start(each), mav_result::denied) << each;
    EXPECT_EQ(world.start(0, each), mav_result::denied) << each;
    EXPECT_EQ(world.picture().mission_state, "idle");
  }
}

TEST(rover, FR_00089_first_0_and_last_0_run_a_mission_of_one_item) {
  rover_in world(1);
  ASSERT_EQ(world.start(0, 0), mav_result::accepted);
  ASSERT_TRUE(world.run_until([&] { return world.picture().mission_state == "completed"; }, 60 * s));
  EXPECT_EQ(world.reached(), (std::vector<int>{0}));
}

TEST(rover, FR_00089_a_start_while_a_transfer_runs_is_temporarily_rejected) {
  rover_in world(2);
  world.send(mavlink::mission_count{.target_system = 1, .target_component = 1, .count = 3});
  EXPECT_EQ(world.start(), mav_result::temporarily_rejected);
  EXPECT_TRUE(world.said("Mission start: a transfer is running"));
  world.run_for(12 * s);
  EXPECT_EQ(world.start(), mav_result::accepted) << "the transfer has timed out, the old mission is there";
}

TEST(rover, FR_00089_a_start_right_after_a_mode_change_is_accepted) {
  for (const float custom : {0.0F, 4.0F, 10.0F, 11.0F}) {
    rover_in world(2);
    ASSERT_EQ(world.mode(custom), mav_result::accepted);
    EXPECT_EQ(world.start(), mav_result::accepted);
    EXPECT_EQ(world.picture().mode, "AUTO");
  }
}

TEST(rover, FR_00089_a_mission_of_do_commands_alone_completes_at_once) {
  rover_in world(0);
  ASSERT_EQ(world.upload(numbered({bare_item(mav_cmd::do_change_speed, 1, 3), bare_item(mav_cmd::do_set_servo, 1)})),
            mav_mission_result::accepted);
  ASSERT_EQ(world.start(), mav_result::accepted);
  world.run_for(200 * ms);
  EXPECT_EQ(world.picture().mission_state, "completed");
  EXPECT_EQ(world.picture().mode, "HOLD");
  EXPECT_TRUE(world.reached().empty());
}

// -- AUTO -------------------------------------------------------------------------------------------

TEST(rover, auto_holds_position_while_the_mission_is_idle) {
  rover_in world(2);
  ASSERT_EQ(world.mode(rover_auto), mav_result::accepted);
  world.run_for(5 * s);
  EXPECT_EQ(world.picture().where.latitude_deg, world.home().latitude_deg);
  EXPECT_EQ(world.picture().mission_state, "idle");
}

TEST(rover, auto_changes_to_hold_when_the_mission_is_completed) {
  rover_in world(2);
  ASSERT_EQ(world.start(), mav_result::accepted);
  ASSERT_TRUE(world.run_until([&] { return world.picture().mission_state == "completed"; }, 60 * s));
  EXPECT_EQ(world.picture().mode, "HOLD");
  world.run_for(200 * ms);
  EXPECT_EQ(world.state(), mavlink::number(mavlink::mission_state::complete));
}

TEST(rover, another_mode_pauses_the_mission_and_auto_goes_on_with_it) {
  rover_in world(3);
  ASSERT_EQ(world.start(), mav_result::accepted);
  ASSERT_TRUE(world.run_until([&] { return world.picture().mission_current == 1; }, 60 * s));
  ASSERT_EQ(world.mode(hold), mav_result::accepted);
  world.run_for(10 * s);
  EXPECT_EQ(world.state(), mavlink::number(mavlink::mission_state::paused));
  EXPECT_EQ(world.last<mavlink::mission_current>()->mission_mode, mavlink::number(mavlink::mission_mode::suspended));
  EXPECT_EQ(world.picture().mission_current, 1);
  ASSERT_EQ(world.mode(rover_auto), mav_result::accepted);
  ASSERT_TRUE(world.run_until([&] { return world.picture().mission_state == "completed"; }, 60 * s));
  EXPECT_EQ(world.reached(), (std::vector<int>{0, 1, 2}));
}

TEST(rover, disarming_ends_the_mission) {
  rover_in world(3);
  ASSERT_EQ(world.start(), mav_result::accepted);
  world.run_for(2 * s);
  ASSERT_EQ(world.command(mav_cmd::component_arm_disarm), mav_result::accepted);
  world.run_for(200 * ms);
  EXPECT_EQ(world.state(), mavlink::number(mavlink::mission_state::not_started));
  EXPECT_EQ(world.picture().mission_state, "idle");
}

// -- what it tells ----------------------------------------------------------------------------------

TEST(rover, tells_a_reached_item_and_the_new_current_one_within_100_ms) {
  rover_in world(3);
  ASSERT_EQ(world.start(), mav_result::accepted);
  ASSERT_TRUE(world.run_until([&] { return !world.reached().empty(); }, 60 * s));
  const auto reached_ns = world.now_ns();
  EXPECT_TRUE(world.run_until([&] { return world.last<mavlink::mission_current>()->seq == 1; }, 100 * ms));
  EXPECT_LE(world.now_ns() - reached_ns, 100 * ms);
  EXPECT_EQ(world.picture().mission_current, 1);
}

TEST(rover, tells_the_current_item_each_second_with_total_and_ids) {
  rover_in world(3);
  world.mark();
  world.run_for(10 * s);
  const auto said = world.each<mavlink::mission_current>();
  EXPECT_EQ(said.size(), 10U);
  EXPECT_EQ(said.back().total, 3);
  EXPECT_NE(said.back().mission_id, 0U);
  EXPECT_EQ(said.back().mission_id, world.picture().mission_id);
}

TEST(rover, says_that_there_is_no_mission_by_state_1_and_total_65535) {
  rover_in world(0);
  EXPECT_EQ(world.state(), mavlink::number(mavlink::mission_state::no_mission));
  EXPECT_EQ(world.last<mavlink::mission_current>()->total, 65535);
}

TEST(rover, says_why_an_item_is_skipped) {
  rover_in world(0);
  auto items = row_of(2, world.home());
  items.insert(items.begin(), item_at(mav_cmd::nav_takeoff, world.home(), {}));
  ASSERT_EQ(world.upload(numbered(items)), mav_mission_result::accepted);
  ASSERT_EQ(world.start(), mav_result::accepted);
  world.run_for(500 * ms);
  EXPECT_TRUE(world.said("Item 0 skipped: a rover does not take off"));
}

// -- set current ------------------------------------------------------------------------------------

TEST(rover, set_current_while_it_runs_goes_there_now) {
  rover_in world(4);
  ASSERT_EQ(world.start(), mav_result::accepted);
  world.set_current(2);
  ASSERT_TRUE(world.run_until([&] { return world.picture().mission_state == "completed"; }, 60 * s));
  EXPECT_EQ(world.reached(), (std::vector<int>{2, 3}));
}

TEST(rover, set_current_while_nothing_runs_is_where_it_starts) {
  rover_in world(4);
  world.set_current(3);
  world.run_for(100 * ms);
  EXPECT_EQ(world.last<mavlink::mission_current>()->seq, 3);
  ASSERT_EQ(world.start(), mav_result::accepted);
  EXPECT_EQ(world.picture().mission_current, 3);
}

TEST(rover, set_current_beyond_the_mission_changes_nothing_and_says_so) {
  rover_in world(4);
  ASSERT_EQ(world.start(1), mav_result::accepted);
  world.set_current(4);
  EXPECT_EQ(world.picture().mission_current, 1);
  EXPECT_TRUE(world.said("Item 4 is not in the mission"));
}

TEST(rover, do_set_mission_current_answers_what_it_did) {
  rover_in world(4);
  EXPECT_EQ(world.command(mav_cmd::do_set_mission_current, {.p1 = 2}), mav_result::accepted);
  EXPECT_EQ(world.picture().mission_current, 2);
  EXPECT_EQ(world.command(mav_cmd::do_set_mission_current, {.p1 = 4}), mav_result::denied);
  EXPECT_EQ(world.command(mav_cmd::do_set_mission_current, {.p1 = -1}), mav_result::accepted);
  EXPECT_EQ(world.picture().mission_current, 2);
}

// -- plans ------------------------------------------------------------------------------------------

TEST(rover, a_mission_that_is_being_driven_is_not_cleared) {
  rover_in world(3);
  ASSERT_EQ(world.start(), mav_result::accepted);
  EXPECT_EQ(world.clear(), mav_mission_result::denied);
  EXPECT_EQ(world.upload({}), mav_mission_result::denied);
  EXPECT_EQ(world.picture().mission_count, 3);
  ASSERT_EQ(world.command(mav_cmd::component_arm_disarm), mav_result::accepted);
  EXPECT_EQ(world.clear(), mav_mission_result::accepted);
  EXPECT_EQ(world.picture().mission_count, 0);
}

TEST(rover, a_new_mission_under_way_ends_the_old_one_and_waits_for_its_start) {
  rover_in world(3);
  ASSERT_EQ(world.start(), mav_result::accepted);
  ASSERT_EQ(world.upload(row_of(5, world.home())), mav_mission_result::accepted);
  EXPECT_EQ(world.picture().mission_state, "idle");
  EXPECT_EQ(world.picture().mode, "AUTO");
  EXPECT_EQ(world.start(), mav_result::accepted);
}

TEST(rover, the_same_mission_again_does_not_disturb_it) {
  rover_in world(3);
  ASSERT_EQ(world.start(), mav_result::accepted);
  ASSERT_EQ(world.upload(row_of(3, world.home())), mav_mission_result::accepted);
  EXPECT_EQ(world.picture().mission_state, "running");
}

// -- modes and commands -----------------------------------------------------------------------------

TEST(rover, changes_its_mode_by_command_and_by_message) {
  rover_in world(2);
  EXPECT_EQ(world.mode(0), mav_result::accepted);
  EXPECT_EQ(world.picture().mode, "MANUAL");
  world.send(mavlink::set_mode{.target_system = 1, .base_mode = 1, .custom_mode = 4});
  EXPECT_EQ(world.picture().mode, "HOLD");
  EXPECT_EQ(world.mode(99), mav_result::denied);
  EXPECT_TRUE(world.said("No such mode 99"));
  EXPECT_EQ(world.picture().mode, "HOLD");
}

TEST(rover, comes_home_and_holds) {
  rover_in world(3);
  ASSERT_EQ(world.start(), mav_result::accepted);
  world.run_for(6 * s);
  EXPECT_EQ(world.command(mav_cmd::nav_return_to_launch), mav_result::accepted);
  EXPECT_EQ(world.picture().mode, "RTL");
  ASSERT_TRUE(world.run_until([&] { return world.picture().mode == "HOLD"; }, 60 * s));
  EXPECT_LT(between(world.picture().where, world.home()).distance_m, 3);
}

TEST(rover, is_paused_and_goes_on_by_command) {
  rover_in world(3);
  EXPECT_EQ(world.command(mav_cmd::do_pause_continue), mav_result::denied) << "nothing runs";
  ASSERT_EQ(world.start(), mav_result::accepted);
  EXPECT_EQ(world.command(mav_cmd::do_pause_continue), mav_result::accepted);
  EXPECT_EQ(world.picture().mode, "HOLD");
  EXPECT_EQ(world.command(mav_cmd::do_pause_continue, {.p1 = 1}), mav_result::accepted);
  EXPECT_EQ(world.picture().mode, "AUTO");
}

TEST(rover, does_not_fly) {
  rover_in world(3);
  EXPECT_EQ(world.command(mav_cmd::nav_takeoff, {.p7 = 5}), mav_result::unsupported);
  EXPECT_EQ(world.command(mav_cmd::nav_land), mav_result::unsupported);
  EXPECT_EQ(world.command(mav_cmd::do_reposition), mav_result::unsupported);
}

TEST(rover, without_a_position_it_neither_arms_nor_starts_and_a_mission_holds) {
  rover_in world(3, false);
  world.subject().lose_position(true, world.now_ns());
  EXPECT_EQ(world.command(mav_cmd::component_arm_disarm, {.p1 = 1}), mav_result::temporarily_rejected);
  EXPECT_EQ(world.start(), mav_result::temporarily_rejected);
  EXPECT_TRUE(world.said("Mission start: no position"));
  world.subject().lose_position(false, world.now_ns());
  ASSERT_EQ(world.command(mav_cmd::component_arm_disarm, {.p1 = 1}), mav_result::accepted);
  ASSERT_EQ(world.start(), mav_result::accepted);
  world.subject().lose_position(true, world.now_ns());
  EXPECT_EQ(world.picture().mode, "HOLD");
  world.mark();
  world.run_for(2 * s);
  EXPECT_TRUE(world.each<mavlink::global_position_int>().empty());
  EXPECT_EQ(world.last<mavlink::gps_raw_int>()->fix_type, 1);
}

TEST(rover, with_an_empty_battery_starts_no_mission) {
  vehicle_world world(vehicle_settings{.who = personality::rover, .arms_on_start = true});
  ASSERT_EQ(world.upload(row_of(2, world.home())), mav_mission_result::accepted);
  world.subject().set_battery(0, world.now_ns());
  world.run_for(1 * s);
  EXPECT_EQ(world.command(mav_cmd::mission_start), mav_result::temporarily_rejected);
  EXPECT_FALSE(world.picture().armed);
}

TEST(rover, goes_to_hold_when_auto_is_chosen_after_the_mission_is_completed) {
  rover_in world(1);
  ASSERT_EQ(world.start(), mav_result::accepted);
  ASSERT_TRUE(world.run_until([&] { return world.picture().mission_state == "completed"; }, 60 * s));
  EXPECT_EQ(world.mode(rover_auto), mav_result::accepted);
  world.run_for(1 * s);
  EXPECT_EQ(world.picture().mode, "HOLD");
}

TEST(rover, an_empty_battery_stops_it) {
  rover_in world(3);
  ASSERT_EQ(world.start(), mav_result::accepted);
  world.subject().set_battery(0, world.now_ns());
  EXPECT_EQ(world.picture().mode, "HOLD");
  EXPECT_FALSE(world.picture().armed);
  EXPECT_EQ(world.command(mav_cmd::component_arm_disarm, {.p1 = 1}), mav_result::temporarily_rejected);
}

} // namespace rover_test
} // namespace godwit::sim::test
