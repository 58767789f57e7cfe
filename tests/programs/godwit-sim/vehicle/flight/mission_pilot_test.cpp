// The rules of a mission's execution, one by one, and what a station hears of it.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "programs/godwit-sim/vehicle/flight/mission_pilot.hpp"
#include "tests/programs/godwit-sim/vehicle/flight/flight_fixture.hpp"

namespace godwit::sim::test {

namespace mission_pilot_test {

using heard = std::vector<std::string>;

TEST(sim_mission_pilot, a_rover_reaches_its_waypoints_one_after_the_other) {
  auto it = rover();
  it.follow({waypoint(20, 0), waypoint(20, 20), waypoint(0, 20)});
  ASSERT_TRUE(it.run_until_said("completed"));
  EXPECT_EQ(it.said, (heard{"begun 0", "reached 0", "begun 1", "reached 1", "begun 2", "reached 2", "completed"}));
}

TEST(sim_mission_pilot, a_multirotor_takes_off_flies_and_lands_and_says_so_in_this_order) {
  auto it = multirotor();
  it.follow({at(nav_takeoff, 0, 0, 10), waypoint(40, 0), at(nav_land, 40, 10, 0)});
  ASSERT_TRUE(it.run_until_said("completed"));
  EXPECT_EQ(it.said, (heard{"begun 0", "took off", "reached 0", "begun 1", "reached 1", "begun 2", "landed",
                            "reached 2", "completed"}));
  EXPECT_FALSE(it.vehicle.is_in_air());
  EXPECT_NEAR(it.from_home_m(), std::hypot(40, 10), 1);
}

TEST(sim_mission_pilot, a_return_item_is_reached_when_the_multirotor_stands_at_home) {
  auto it = multirotor();
  it.follow({at(nav_takeoff, 0, 0, 10), waypoint(60, 0), command(nav_return_to_launch)});
  ASSERT_TRUE(it.run_until_said("completed"));
  EXPECT_EQ((heard{it.said.end() - 4, it.said.end()}), (heard{"begun 2", "landed", "reached 2", "completed"}));
  EXPECT_LT(it.from_home_m(), 1);
}

TEST(sim_mission_pilot, a_mission_that_begins_with_a_waypoint_takes_off_to_its_altitude_first) {
  auto it = multirotor();
  it.follow({waypoint(40, 0, 25)});
  ASSERT_TRUE(it.run_until([&] { return it.vehicle.altitude_above_home_m() > 24; }));
  EXPECT_LT(it.from_home_m(), 0.1);
  ASSERT_TRUE(it.run_until_said("completed"));
  EXPECT_EQ(it.said, (heard{"begun 0", "took off", "reached 0", "completed"}));
}

TEST(sim_mission_pilot, reached_comes_after_the_hold_and_the_hold_begins_with_the_first_arrival) {
  auto it = rover();
  it.follow({waypoint(20, 0, 0, 5), waypoint(20, 20)});
  ASSERT_TRUE(it.run_until([&] { return it.from_home_m() > 18; }));
  const double arrival_s = static_cast<double>(it.now_ns) * 1e-9;
  ASSERT_TRUE(it.run_until_said("reached 0"));
  EXPECT_NEAR(it.time_of("reached 0") - arrival_s, 5, 0.1);
}

TEST(sim_mission_pilot, reached_is_said_in_the_step_in_which_the_next_item_begins_and_before_it) {
  auto it = rover();
  it.follow({waypoint(20, 0), waypoint(40, 0)});
  ASSERT_TRUE(it.run_until_said("begun 1"));
  EXPECT_EQ(it.time_of("reached 0"), it.time_of("begun 1"));
}

// copter_does of ArduCopter 4.7.0-dev: REACHED 4, "Mission: 4 SetROILocation", "Mission: 6 WP", CURRENT 6.
TEST(sim_mission_pilot, do_commands_between_two_items_run_when_the_first_of_them_is_reached) {
  auto it = rover();
  it.follow({waypoint(20, 0), command(do_change_speed, 1, 0.5F), command(186), waypoint(40, 0)});
  ASSERT_TRUE(it.run_until_said("begun 3"));
  EXPECT_EQ(it.said, (heard{"begun 0", "reached 0", "begun 3", "executed 1", "skipped 2: command 186 is not known"}));
  it.run(10);
  EXPECT_NEAR(it.vehicle.where().ground_speed_mps, 0.5, 1e-9);
}

TEST(sim_mission_pilot, an_unknown_do_command_is_skipped_with_a_reason_and_is_not_reached) {
  auto it = rover();
  it.follow({command(186), waypoint(10, 0)});
  ASSERT_TRUE(it.run_until_said("completed"));
  EXPECT_EQ(it.said, (heard{"begun 0", "begun 1", "skipped 0: command 186 is not known", "reached 1", "completed"}));
}

TEST(sim_mission_pilot, an_unknown_nav_command_is_skipped_with_a_reason_and_is_not_reached) {
  auto it = rover();
  it.follow({at(23, 10, 0), command(221), waypoint(10, 0)});
  ASSERT_TRUE(it.run_until_said("completed"));
  EXPECT_EQ(it.said, (heard{"begun 0", "skipped 0: command 23 is not known", "begun 2",
                            "skipped 1: command 221 is not known", "reached 2", "completed"}));
}

TEST(sim_mission_pilot, a_rover_skips_the_take_off_and_stops_where_it_should_land) {
  auto it = rover();
  it.follow({at(nav_takeoff, 0, 0, 10), at(nav_land, 20, 0, 0)});
  ASSERT_TRUE(it.run_until_said("completed"));
  EXPECT_EQ(it.said, (heard{"begun 0", "skipped 0: a rover does not take off", "begun 1", "reached 1", "completed"}));
  it.run(5);
  EXPECT_NEAR(it.from_home_m(), 20, 0.6);
  EXPECT_FALSE(it.vehicle.is_moving());
}

TEST(sim_mission_pilot, autocontinue_0_holds_after_the_item) {
  auto it = rover();
  it.follow({held(waypoint(20, 0)), waypoint(60, 0)});
  ASSERT_TRUE(it.run_until_said("reached 0"));
  it.run(60);
  EXPECT_EQ(it.said, (heard{"begun 0", "reached 0"}));
  EXPECT_EQ(it.vehicle.mission().state(), run_state::running);
  EXPECT_NEAR(it.from_home_m(), 20, 2);
  ASSERT_TRUE(it.vehicle.mission().set_current(1));
  ASSERT_TRUE(it.run_until_said("completed"));
  EXPECT_EQ(it.said.back(), "completed");
}

TEST(sim_mission_pilot, a_mission_of_do_commands_alone_completes_at_once) {
  auto it = rover();
  it.follow({command(do_change_speed, 1, 1), held(command(condition_delay, 60)), command(186)});
  it.run(0.1);
  EXPECT_EQ(it.said, (heard{"begun 0", "begun 1", "begun 2", "executed 0", "executed 1",
                            "skipped 2: command 186 is not known", "completed"}));
  EXPECT_EQ(it.vehicle.mission().state(), run_state::completed);
}

TEST(sim_mission_pilot, set_current_while_running_goes_there_now) {
  auto it = rover();
  it.follow({waypoint(100, 0), waypoint(200, 0), waypoint(0, 20)});
  it.run(5);
  ASSERT_TRUE(it.vehicle.mission().set_current(2));
  ASSERT_TRUE(it.run_until_said("completed"));
  EXPECT_EQ(it.said, (heard{"begun 0", "begun 2", "reached 2", "completed"}));
}

TEST(sim_mission_pilot, a_start_while_running_begins_again_at_the_new_item) {
  auto it = rover();
  it.follow({waypoint(10, 0), waypoint(20, 0)});
  ASSERT_TRUE(it.run_until_said("begun 1"));
  it.vehicle.mission().start(0);
  ASSERT_TRUE(it.run_until_said("completed"));
  EXPECT_EQ(it.said,
            (heard{"begun 0", "reached 0", "begun 1", "begun 0", "reached 0", "begun 1", "reached 1", "completed"}));
}

TEST(sim_mission_pilot, the_last_item_asked_for_is_the_last_one) {
  auto it = rover();
  it.follow({waypoint(10, 0), waypoint(20, 0), waypoint(30, 0)}, 1, 1);
  ASSERT_TRUE(it.run_until_said("completed"));
  EXPECT_EQ(it.said, (heard{"begun 1", "reached 1", "completed"}));
}

TEST(sim_mission_pilot, a_change_of_speed_lasts_until_the_next_start) {
  auto it = rover();
  it.follow({waypoint(10, 0), command(do_change_speed, 1, 0.5F), waypoint(20, 0)});
  ASSERT_TRUE(it.run_until_said("begun 2"));
  it.run(3);
  EXPECT_NEAR(it.vehicle.where().ground_speed_mps, 0.5, 1e-9);
  it.vehicle.mission().start(2);
  it.run(3);
  EXPECT_NEAR(it.vehicle.where().ground_speed_mps, 2, 1e-9);
}

TEST(sim_mission_pilot, a_change_of_speed_takes_effect_on_the_leg_after_it) {
  auto it = multirotor();
  it.follow({at(nav_takeoff, 0, 0, 5), command(do_change_speed, 1, 9), waypoint(300, 0)});
  ASSERT_TRUE(it.run_until_said("begun 2"));
  it.run(10);
  EXPECT_NEAR(it.vehicle.where().ground_speed_mps, 9, 1e-6);
}

TEST(sim_mission_pilot, a_new_home_is_where_a_return_leads) {
  auto it = rover();
  it.follow({waypoint(30, 0), at(do_set_home, 0, 20, 0), command(nav_return_to_launch)});
  ASSERT_TRUE(it.run_until_said("completed"));
  EXPECT_LT(between(it.vehicle.where().where, moved(home, {90, 20})).distance_m, 2.1);
}

TEST(sim_mission_pilot, condition_delay_holds_back_the_commands_after_it) {
  auto it = rover();
  it.follow({waypoint(20, 0), command(condition_delay, 5), command(186), waypoint(100, 0)});
  ASSERT_TRUE(it.run_until_said("skipped 2: command 186 is not known"));
  EXPECT_NEAR(it.time_of("skipped 2: command 186 is not known") - it.time_of("begun 3"), 5, 0.1);
}

TEST(sim_mission_pilot, what_a_delay_holds_back_longer_than_the_item_is_not_carried_out) {
  auto it = rover();
  it.follow({waypoint(10, 0), command(condition_delay, 600), command(do_change_speed, 1, 0.5F), waypoint(30, 0)});
  ASSERT_TRUE(it.run_until_said("completed"));
  EXPECT_EQ(it.said, (heard{"begun 0", "reached 0", "begun 3", "executed 1", "reached 3",
                            "skipped 2: its delay was longer than the item beside it", "completed"}));
  EXPECT_LT(it.time_of("completed"), 20);
}

TEST(sim_mission_pilot, a_jump_repeats_what_it_says) {
  auto it = rover();
  it.follow({waypoint(10, 0), waypoint(20, 0), jump_to(0, 1)});
  ASSERT_TRUE(it.run_until_said("completed"));
  EXPECT_EQ(it.said, (heard{"begun 0", "reached 0", "begun 1", "reached 1", "begun 0", "reached 0", "begun 1",
                            "reached 1", "completed"}));
}

TEST(sim_mission_pilot, loiter_time_counts_from_the_arrival_and_loiter_unlim_never_ends) {
  auto it = multirotor();
  auto loiter = at(nav_loiter_time, 20, 0);
  loiter.param1 = 8;
  it.follow({at(nav_takeoff, 0, 0, 10), loiter, at(nav_loiter_unlim, 0, 20)});
  ASSERT_TRUE(it.run_until_said("reached 1"));
  EXPECT_GT(it.time_of("reached 1") - it.time_of("begun 1"), 8 + 18 / 5.0);
  it.run(300);
  EXPECT_EQ(it.said.back(), "begun 2");
  EXPECT_NEAR(it.from_home_m(), 20, 0.2);
  EXPECT_EQ(it.vehicle.next_step_ns(), flight::never_ns);
}

// acts_copter: switched on at the first place, it takes one there and one each ten metres, none at the end of 60 m.
TEST(sim_mission_pilot, a_trigger_by_distance_takes_a_picture_each_so_many_metres) {
  auto it = multirotor();
  auto on = command(do_set_cam_trigg_dist, 10);
  on.param3 = 1;
  it.follow({at(nav_takeoff, 0, 0, 10), waypoint(20, 0), on, waypoint(20, 60), command(do_set_cam_trigg_dist, 0),
             waypoint(0, 60)});
  ASSERT_TRUE(it.run_until_said("completed"));
  EXPECT_NEAR(std::ranges::count(it.said, "pictured"), 6, 1);
  EXPECT_EQ(std::ranges::find(std::ranges::find(it.said, "reached 3"), it.said.end(), "pictured"), it.said.end());
}

TEST(sim_mission_pilot, a_gripper_has_released_its_load_half_a_second_after_the_command) {
  auto it = multirotor();
  it.follow({at(nav_takeoff, 0, 0, 10), waypoint(20, 0), command(do_gripper, 1, 0), waypoint(60, 0)});
  ASSERT_TRUE(it.run_until_said("released"));
  EXPECT_NEAR(it.time_of("released") - it.time_of("executed 2"), 0.5, 0.05);
}

TEST(sim_mission_pilot, a_delay_waits_where_it_is) {
  auto it = rover();
  it.follow({waypoint(10, 0), command(nav_delay, 6), waypoint(20, 0)});
  ASSERT_TRUE(it.run_until_said("reached 1"));
  EXPECT_NEAR(it.time_of("reached 1") - it.time_of("reached 0"), 6, 0.1);
}

TEST(sim_mission_pilot, after_a_pause_the_item_goes_on_and_is_not_said_to_begin_again) {
  auto it = rover();
  it.follow({waypoint(40, 0), command(186)});
  it.run(5);
  it.vehicle.set_task(task::hold{});
  it.run(20);
  const double paused_m = it.from_home_m();
  EXPECT_LT(paused_m, 15);
  EXPECT_EQ(it.vehicle.mission().state(), run_state::running);
  it.vehicle.set_task(task::follow_mission{});
  ASSERT_TRUE(it.run_until_said("completed"));
  EXPECT_EQ(it.said, (heard{"begun 0", "reached 0", "skipped 1: command 186 is not known", "completed"}));
}

TEST(sim_mission_pilot, a_take_off_that_was_paused_goes_on_where_it_began) {
  auto it = multirotor();
  it.follow({at(nav_takeoff, 30, 0, 20)});
  ASSERT_TRUE(it.run_until([&] { return it.vehicle.altitude_above_home_m() > 5; }));
  it.vehicle.set_task(task::land{});
  ASSERT_TRUE(it.run_until_said("landed"));
  it.vehicle.set_task(task::follow_mission{});
  ASSERT_TRUE(it.run_until_said("completed"));
  EXPECT_EQ(it.said, (heard{"begun 0", "took off", "landed", "took off", "reached 0", "completed"}));
}

TEST(sim_mission_pilot, when_it_is_complete_it_stays_there_and_back_in_the_mission_it_stays_where_it_is) {
  auto it = multirotor();
  it.follow({waypoint(30, 0)});
  ASSERT_TRUE(it.run_until_said("completed"));
  it.run(20);
  EXPECT_NEAR(it.from_home_m(), 30, 0.2);
  it.vehicle.set_task(task::come_back{});
  ASSERT_TRUE(it.run_until_said("landed"));
  it.vehicle.set_task(task::follow_mission{});
  it.run(20);
  EXPECT_FALSE(it.vehicle.is_in_air());
  EXPECT_LT(it.from_home_m(), 1);
}

TEST(sim_mission_pilot, a_stopped_run_holds) {
  auto it = rover();
  it.follow({waypoint(100, 0)});
  it.run(5);
  it.vehicle.mission().stop();
  it.run(10);
  EXPECT_FALSE(it.vehicle.is_moving());
  EXPECT_LT(it.from_home_m(), 15);
  EXPECT_EQ(it.said, heard{"begun 0"});
}

TEST(sim_mission_pilot, a_plan_replaced_on_the_way_goes_on_at_the_given_item) {
  auto it = rover();
  it.follow({waypoint(100, 0), waypoint(200, 0)});
  it.run(5);
  it.vehicle.mission().replace({waypoint(0, 50), waypoint(0, 10)}, 0, 1);
  ASSERT_TRUE(it.run_until_said("completed"));
  EXPECT_EQ(it.said, (heard{"begun 0", "begun 1", "reached 1", "completed"}));
}

TEST(sim_mission_pilot, an_item_left_for_one_that_is_skipped_is_not_flown_on) {
  auto it = rover();
  it.follow({waypoint(100, 0), at(31, 0, 0)});
  it.run(5);
  ASSERT_TRUE(it.vehicle.mission().set_current(1));
  it.run(20);
  EXPECT_EQ(it.said.back(), "completed");
  EXPECT_LT(it.from_home_m(), 15);
  EXPECT_FALSE(it.vehicle.is_moving());
}

TEST(sim_mission_pilot, home_at_item_0_is_not_flown) {
  auto it = rover();
  it.vehicle.mission().load({waypoint(0, 0), waypoint(10, 0)}, 1);
  it.vehicle.mission().start(0);
  it.vehicle.set_task(task::follow_mission{});
  ASSERT_TRUE(it.run_until_said("completed"));
  EXPECT_EQ(it.said, (heard{"begun 1", "reached 1", "completed"}));
}

} // namespace mission_pilot_test

namespace do_command_test {

constexpr position here{46, 7, 433};

struct sim_do_command : testing::Test {
  craft what = multirotor_craft();
  pace how_fast = own_pace(what);
  position home_now = home;

  std::optional<std::string> carry(const item& which) { return execute_command(which, what, here, how_fast, home_now); }
};

TEST_F(sim_do_command, change_speed_knows_four_kinds) {
  EXPECT_EQ(carry(command(do_change_speed, 0, 7)), std::nullopt);
  EXPECT_EQ(how_fast.speed_mps, 7);
  EXPECT_EQ(carry(command(do_change_speed, 1, 8)), std::nullopt);
  EXPECT_EQ(how_fast.speed_mps, 8);
  EXPECT_EQ(carry(command(do_change_speed, 2, 1)), std::nullopt);
  EXPECT_EQ(how_fast.climb_mps, 1);
  EXPECT_EQ(carry(command(do_change_speed, 3, 0.5F)), std::nullopt);
  EXPECT_EQ(how_fast.descent_mps, 0.5);
  EXPECT_EQ(carry(command(do_change_speed, 4, 1)), "this kind of speed is not known");
}

TEST_F(sim_do_command, minus_1_keeps_the_speed_and_minus_2_is_the_crafts_own) {
  how_fast.speed_mps = 9;
  EXPECT_EQ(carry(command(do_change_speed, 1, -1)), std::nullopt);
  EXPECT_EQ(how_fast.speed_mps, 9);
  EXPECT_EQ(carry(command(do_change_speed, 1, -2)), std::nullopt);
  EXPECT_EQ(how_fast.speed_mps, what.speed_mps);
}

TEST_F(sim_do_command, a_speed_of_nothing_is_refused_and_every_other_is_bounded) {
  for (const float none : {0.0F, -5.0F, std::nanf("")}) {
    EXPECT_EQ(carry(command(do_change_speed, 1, none)), "it names no speed") << none;
    EXPECT_EQ(how_fast.speed_mps, what.speed_mps);
  }
  EXPECT_EQ(carry(command(do_change_speed, 1, 1e9F)), std::nullopt);
  EXPECT_EQ(how_fast.speed_mps, 20);
  EXPECT_EQ(carry(command(do_change_speed, 1, 1e-9F)), std::nullopt);
  EXPECT_EQ(how_fast.speed_mps, 0.1);
}

TEST_F(sim_do_command, home_is_set_here_or_at_the_position) {
  EXPECT_EQ(carry(command(do_set_home, 1)), std::nullopt);
  EXPECT_EQ(home_now, here);
  auto place = at(do_set_home, 100, 0, 500);
  place.frame = 0;
  EXPECT_EQ(carry(place), std::nullopt);
  EXPECT_EQ(home_now.altitude_m, 500);
  EXPECT_NEAR(between(home, home_now).distance_m, 100, 0.02);
}

TEST_F(sim_do_command, a_home_that_is_not_on_earth_is_refused) {
  auto place = at(do_set_home, 0, 0, 0);
  place.x = 2'000'000'000;
  EXPECT_EQ(carry(place), "its position is not on Earth");
  EXPECT_EQ(home_now, home);
}

TEST_F(sim_do_command, what_is_not_known_says_so) {
  for (const std::uint16_t each : {186, 208, 12'345}) // refused by all, guarded, no command
    EXPECT_EQ(carry(command(each)), "command " + std::to_string(each) + " is not known");
}

TEST_F(sim_do_command, cameras_servos_and_grippers_are_executed_in_silence) {
  for (const std::uint16_t each : {183, 195, 201, 205, 206, 211, 2000, 3000})
    EXPECT_EQ(carry(command(each)), std::nullopt) << each;
}

TEST_F(sim_do_command, jumps_delays_and_marks_are_passed_over_in_silence) {
  for (const auto each : {do_jump, condition_delay, do_land_start})
    EXPECT_EQ(carry(command(each, 1, 1)), std::nullopt) << each;
}

} // namespace do_command_test

} // namespace godwit::sim::test
