// MISSION_START on the ground port: FR-00089, its risks, and the edges of its parameters.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/actors/ground_port/port_fixture.hpp"
#include "tests/actors/ground_port/results.hpp"

namespace godwit::ground_port {
namespace core_start_test {

using namespace test;
using executor::start_verdict;
using mavlink::mav_result;
using mavlink::mission_state;

// A port that holds a mission.
struct loaded : port_fixture {
  explicit loaded(int items = 5, bool has_executor = true) : port_fixture({}, has_executor) {
    upload(items);
    forget();
  }
  int start(float first = 0, float last = 0) {
    say(start_command(first, last));
    return last_result();
  }
};

// -- acceptance criteria --------------------------------------------------------------------------

TEST(FR_00089_ground_port, mission_start_is_handled) {
  loaded port;
  port.start();
  port.executor_answers(start_verdict::started);
  EXPECT_EQ(port.last<mavlink::command_ack>().command, 300);
  EXPECT_EQ(port.last<mavlink::command_ack>().target_system, station_id.system);
  EXPECT_EQ(port.last<mavlink::command_ack>().target_component, station_id.component);
}

TEST(FR_00089_ground_port, it_is_accepted_only_when_the_executor_has_changed_to_the_mission_mode) {
  loaded port;
  EXPECT_EQ(port.start(), -1) << "no answer before the executor's";
  ASSERT_EQ(port.starts.size(), 1U);
  port.executor_answers(start_verdict::started);
  EXPECT_EQ(port.last_result(), accepted);
  loaded stuck;
  stuck.start();
  stuck.executor_answers(start_verdict::failed, "mode change refused");
  EXPECT_EQ(stuck.last_result(), failed);
  EXPECT_TRUE(stuck.said("Mission start: mode change refused"));
}

TEST(FR_00089_ground_port, an_empty_mission_is_not_started) {
  port_fixture port;
  port.say(start_command());
  EXPECT_TRUE(port.starts.empty());
}

TEST(FR_00089_ground_port, it_sets_the_mission_state_to_running) {
  loaded port;
  EXPECT_EQ(port.shown().plans[0].items, 5U);
  port.start();
  port.executor_answers(start_verdict::started);
  port.advance(100 * ms);
  EXPECT_EQ(port.last<mavlink::mission_current>().mission_state, mavlink::number(mission_state::active));
}

TEST(FR_00089_ground_port, it_sets_the_current_item_to_the_first_or_to_the_one_that_is_named) {
  loaded port;
  port.start();
  EXPECT_EQ(port.starts.back().first, 0);
  EXPECT_EQ(port.starts.back().last, 4);
  port.executor_answers(start_verdict::started);
  port.start(2, 3);
  EXPECT_EQ(port.starts.back().first, 2);
  EXPECT_EQ(port.starts.back().last, 3);
  port.executor_answers(start_verdict::started);
  port.advance(100 * ms);
  EXPECT_EQ(port.last<mavlink::mission_current>().seq, 2);
}

TEST(FR_00089_ground_port, success_is_accepted) {
  loaded port;
  port.start();
  port.executor_answers(start_verdict::started);
  EXPECT_EQ(port.last_result(), accepted);
}

TEST(FR_00089_ground_port, without_a_mission_it_fails) {
  port_fixture port;
  port.say(start_command());
  EXPECT_EQ(port.last_result(), failed);
  EXPECT_TRUE(port.said("Mission start: no mission"));
}

TEST(FR_00089_ground_port, a_statustext_says_mission_started) {
  loaded port;
  port.start();
  EXPECT_FALSE(port.said("Mission started"));
  port.executor_answers(start_verdict::started);
  EXPECT_TRUE(port.said("Mission started"));
}

// -- risks ----------------------------------------------------------------------------------------

TEST(FR_00089_ground_port, risk_started_while_disarmed_is_denied) {
  loaded port;
  port.start();
  port.executor_answers(start_verdict::disarmed);
  EXPECT_EQ(port.last_result(), denied);
  EXPECT_TRUE(port.said("Mission start: disarmed"));
}

TEST(FR_00089_ground_port, risk_an_invalid_first_item_fails) {
  loaded port;
  EXPECT_EQ(port.start(5), failed);
  EXPECT_EQ(port.start(65'535), failed);
  EXPECT_TRUE(port.starts.empty());
}

TEST(FR_00089_ground_port, risk_a_start_during_navigation_goes_to_the_new_start_item) {
  loaded port;
  port.start();
  port.executor_answers(start_verdict::started);
  port.executor_says(mission_progress{port.starts[0].plan_id, 3, mission_state::active});
  port.advance(5 * s);
  port.start(1);
  ASSERT_EQ(port.starts.size(), 2U);
  EXPECT_EQ(port.starts[1].first, 1);
  port.executor_answers(start_verdict::started);
  EXPECT_EQ(port.last_result(), accepted);
  port.advance(100 * ms);
  EXPECT_EQ(port.last<mavlink::mission_current>().seq, 1);
}

// -- edges ----------------------------------------------------------------------------------------

TEST(FR_00089_ground_port, last_item_before_the_first_is_denied) {
  loaded port;
  EXPECT_EQ(port.start(3, 2), denied);
}

TEST(FR_00089_ground_port, last_item_beyond_the_mission_is_denied) {
  loaded port;
  EXPECT_EQ(port.start(0, 5), denied);
}

TEST(FR_00089_ground_port, parameters_that_are_no_item_numbers_are_denied) {
  loaded port;
  for (const float bad : {-1.0F, 1.5F, NAN, INFINITY, -INFINITY}) {
    port.forget();
    EXPECT_EQ(port.start(bad, 0), denied) << bad;
    port.forget();
    EXPECT_EQ(port.start(0, bad), denied) << bad;
  }
  EXPECT_TRUE(port.starts.empty());
}

TEST(FR_00089_ground_port, huge_parameters_are_beyond_the_mission) {
  loaded port;
  for (const float huge : {1e20F, std::numeric_limits<float>::max(), 4294967296.0F}) {
    EXPECT_EQ(port.start(huge, 0), failed);
    EXPECT_EQ(port.start(0, huge), denied);
  }
}

TEST(FR_00089_ground_port, first_0_and_last_0_start_a_mission_of_one_item) {
  loaded port(1);
  port.start();
  ASSERT_EQ(port.starts.size(), 1U);
  EXPECT_EQ(port.starts[0].first, 0);
  EXPECT_EQ(port.starts[0].last, 0);
}

TEST(FR_00089_ground_port, a_start_while_a_transfer_runs_is_rejected_for_now) {
  loaded port;
  port.say(mavlink::mission_count{.count = 3}, other_station);
  EXPECT_EQ(port.start(), temporarily_rejected);
  EXPECT_TRUE(port.said("Mission start: a transfer is running"));
  EXPECT_TRUE(port.starts.empty());
}

TEST(FR_00089_ground_port, a_start_while_the_plan_is_not_on_the_disk_is_rejected_for_now) {
  port_fixture port;
  port.slow_disk();
  port.upload(3);
  port.say(start_command());
  EXPECT_EQ(port.last_result(), temporarily_rejected);
  port.settle_disk();
  port.say(start_command());
  EXPECT_EQ(port.starts.size(), 1U);
}

TEST(FR_00089_ground_port, a_start_while_a_plan_is_read_is_not_hindered) {
  loaded port;
  port.say(mavlink::mission_request_list{}, other_station);
  port.start();
  EXPECT_EQ(port.starts.size(), 1U);
}

TEST(FR_00089_ground_port, a_vehicle_that_is_not_ready_rejects_it_for_now_and_says_why) {
  loaded port;
  port.start();
  port.executor_answers(start_verdict::not_ready, "no 3-D fix");
  EXPECT_EQ(port.last_result(), temporarily_rejected);
  EXPECT_TRUE(port.said("Mission start: no 3-D fix"));
}

TEST(FR_00089_ground_port, a_start_right_after_a_mode_change_is_the_executors_to_decide) {
  loaded port;
  port.vehicle_says(mavlink::heartbeat{.base_mode = 128, .custom_mode = 4});
  port.start();
  ASSERT_EQ(port.starts.size(), 1U);
  port.executor_answers(start_verdict::not_ready, "the mode has just changed");
  EXPECT_EQ(port.last_result(), temporarily_rejected);
}

TEST(FR_00089_ground_port, a_mission_of_do_items_alone_is_started_and_completes) {
  port_fixture port;
  port.upload({waypoint(0, 178), waypoint(1, 178)});
  port.say(start_command());
  ASSERT_EQ(port.starts.size(), 1U);
  port.executor_answers(start_verdict::started);
  EXPECT_EQ(port.last_result(), accepted);
  port.executor_says(mission_progress{port.starts[0].plan_id, 1, mission_state::complete});
  port.advance(100 * ms);
  EXPECT_EQ(port.last<mavlink::mission_current>().mission_state, mavlink::number(mission_state::complete));
}

TEST(FR_00089_ground_port, it_is_taken_as_command_int_too) {
  loaded port;
  port.say(mavlink::command_int{.command = 300, .param1 = 2});
  ASSERT_EQ(port.starts.size(), 1U);
  EXPECT_EQ(port.starts[0].first, 2);
}

// -- no executor ----------------------------------------------------------------------------------

TEST(FR_00089_ground_port, without_an_executor_it_is_rejected_for_now_and_said_so) {
  loaded port(5, false);
  EXPECT_EQ(port.start(), temporarily_rejected);
  EXPECT_TRUE(port.said("Mission start: no executor is there"));
}

TEST(FR_00089_ground_port, an_executor_that_is_silent_is_not_waited_for_for_ever) {
  loaded port;
  port.start();
  port.advance(start_dedup::answer_patience_ns);
  EXPECT_EQ(port.last_result(), temporarily_rejected);
  EXPECT_TRUE(port.said("Mission start: the executor does not answer"));
  EXPECT_LE(port.starts[0].obey_until_ns, port.now().wall_ns) << "it must not start when it wakes up";
}

TEST(FR_00089_ground_port, an_answer_after_the_patience_was_used_up_corrects_what_was_said) {
  loaded port;
  port.start();
  port.advance(start_dedup::answer_patience_ns);
  port.forget();
  port.executor_answers(start_verdict::started);
  EXPECT_TRUE(port.said("Mission started"));
  EXPECT_TRUE(port.sent<mavlink::command_ack>().empty()) << "the command has been answered";
  port.start();
  EXPECT_EQ(port.last_result(), accepted) << "its repetition hears the truth";
  EXPECT_EQ(port.starts.size(), 1U);
}

// -- repetitions ----------------------------------------------------------------------------------

TEST(FR_00089_ground_port, a_repetition_while_the_executor_works_is_not_given_to_it_again) {
  loaded port;
  port.start();
  for (std::uint8_t confirmation = 1; confirmation < 4; ++confirmation) {
    port.advance(500 * ms);
    port.say(start_command(0, 0, confirmation));
    EXPECT_EQ(port.last_result(), in_progress);
  }
  port.advance(100 * ms);
  port.say(start_command()); // as MAVSDK does, which does not count
  EXPECT_EQ(port.last_result(), in_progress);
  EXPECT_EQ(port.starts.size(), 1U);
}

TEST(FR_00089_ground_port, a_repetition_after_the_answer_gets_the_same_answer) {
  loaded port;
  port.start();
  port.executor_answers(start_verdict::started);
  for (const std::uint8_t confirmation : {1, 2, 0}) {
    port.forget();
    port.advance(500 * ms);
    port.say(start_command(0, 0, confirmation));
    EXPECT_EQ(port.last_result(), accepted);
  }
  EXPECT_EQ(port.starts.size(), 1U);
}

TEST(FR_00089_ground_port, the_same_command_much_later_is_a_new_start) {
  loaded port;
  port.start();
  port.executor_answers(start_verdict::started);
  port.advance(2'001 * ms);
  port.start();
  EXPECT_EQ(port.starts.size(), 2U);
  EXPECT_GT(port.starts[1].key, port.starts[0].key);
}

TEST(FR_00089_ground_port, another_stations_start_meanwhile_is_rejected_for_now) {
  loaded port;
  port.start();
  port.say(start_command(), other_station);
  EXPECT_EQ(port.last_result(), temporarily_rejected);
  EXPECT_EQ(port.last<mavlink::command_ack>().target_system, other_station.system);
  EXPECT_EQ(port.starts.size(), 1U);
}

TEST(FR_00089_ground_port, an_invalid_start_of_another_station_meanwhile_is_denied_all_the_same) {
  loaded port;
  port.start();
  port.say(start_command(NAN), other_station);
  EXPECT_EQ(port.last_result(), denied);
}

// -- crashes --------------------------------------------------------------------------------------

TEST(FR_00089_ground_port, a_crash_while_the_executor_works_asks_it_no_second_time) {
  loaded port;
  port.start();
  port.crash();
  EXPECT_EQ(port.starts.size(), 1U);
  port.say(start_command(0, 0, 1));
  EXPECT_EQ(port.last_result(), in_progress);
  port.executor_answers(start_verdict::started);
  EXPECT_EQ(port.last_result(), accepted);
  EXPECT_EQ(port.starts.size(), 1U);
}

TEST(FR_00089_ground_port, a_crash_after_the_answer_gives_the_same_answer_to_a_repetition) {
  loaded port;
  port.start();
  port.executor_answers(start_verdict::started);
  port.crash();
  port.forget();
  port.say(start_command());
  EXPECT_EQ(port.last_result(), accepted);
  EXPECT_EQ(port.starts.size(), 1U);
}

TEST(FR_00089_ground_port, a_start_that_did_not_reach_the_disk_was_not_asked_for) {
  loaded port;
  port.slow_disk();
  port.start();
  EXPECT_TRUE(port.starts.empty());
  port.crash();
  port.say(start_command(0, 0, 1));
  EXPECT_EQ(port.starts.size(), 1U);
}

TEST(FR_00089_ground_port, a_restart_long_after_the_question_settles_it_at_once) {
  loaded port;
  port.start();
  port.crash();
  port.forget();
  port.advance(start_dedup::answer_patience_ns);
  EXPECT_EQ(port.last_result(), temporarily_rejected);
  EXPECT_EQ(port.starts.size(), 1U);
}

// -- the plan that the station sees ---------------------------------------------------------------

// Found with QGroundControl: after a go-to and an emergency stop its slider flew the two items that were left of the
// go-to, while it showed the five that it had uploaded.
TEST(ground_port_start, a_start_flies_the_plan_that_its_station_shows_or_is_refused) {
  loaded port;
  port.executor_says(set_mission{waypoints(2)}); // of a go-to
  EXPECT_EQ(port.start(), temporarily_rejected);
  EXPECT_TRUE(port.starts.empty());
  EXPECT_TRUE(port.said("Mission start: the plan has changed; load it"));
  (void)port.download();
  port.start();
  ASSERT_EQ(port.starts.size(), 1U) << "now it shows what is flown";
  EXPECT_EQ(port.starts[0].last, 1);
}

TEST(ground_port_start, a_station_that_uploads_its_plan_again_flies_it) {
  loaded port;
  port.executor_says(set_mission{waypoints(2)});
  port.upload(5);
  port.start();
  ASSERT_EQ(port.starts.size(), 1U);
  EXPECT_EQ(port.starts[0].last, 4);
}

TEST(ground_port_start, a_station_whose_upload_was_refused_shows_it_all_the_same) {
  loaded port;
  port.objects = true;
  EXPECT_NE(port.upload(4).type, 0);
  port.objects = false;
  EXPECT_EQ(port.start(), temporarily_rejected) << "the plan from before is the one here";
  EXPECT_TRUE(port.starts.empty());
}

TEST(ground_port_start, what_another_station_has_uploaded_since_is_not_what_the_first_one_starts) {
  loaded port;
  (void)port.upload(waypoints(3), 0, other_station);
  EXPECT_EQ(port.start(), temporarily_rejected);
  port.say(start_command(), other_station);
  ASSERT_EQ(port.starts.size(), 1U);
  EXPECT_EQ(port.starts[0].asked_by, (executor::station{254, 190}));
}

TEST(ground_port_start, a_part_of_a_download_shows_nothing) {
  loaded port;
  port.executor_says(set_mission{waypoints(2)});
  port.say(mavlink::mission_request_list{});
  port.say(mavlink::mission_request_int{.seq = 0});
  EXPECT_EQ(port.start(), temporarily_rejected);
}

TEST(ground_port_start, a_station_that_has_loaded_no_plan_starts_what_there_is) {
  loaded port;
  port.say(start_command(), other_station);
  EXPECT_EQ(port.starts.size(), 1U);
}

TEST(ground_port_start, what_a_station_has_uploaded_is_known_after_a_crash) {
  loaded port;
  port.executor_says(set_mission{waypoints(2)});
  port.crash();
  EXPECT_EQ(port.start(), temporarily_rejected);
  EXPECT_TRUE(port.starts.empty());
}

TEST(ground_port_start, of_a_flight_under_way_a_start_goes_on_whatever_is_shown) {
  loaded port;
  port.executor_says(set_mission{waypoints(2)});
  port.executor_says(mission_progress{port.shown().plans[0].plan_id, 1, mission_state::paused});
  port.start();
  EXPECT_EQ(port.starts.size(), 1U);
}

// An ArduPilot's home is item 0, and moves when it is armed.
TEST(ground_port_start, a_home_that_has_moved_makes_no_other_plan) {
  loaded port;
  mavlink::heartbeat copter;
  copter.type = mavlink::number(mavlink::mav_type::quadrotor);
  copter.autopilot = mavlink::number(mavlink::mav_autopilot::ardupilotmega);
  port.vehicle_says(copter);
  auto moved = waypoints(5);
  moved[0].x += 100;
  port.executor_says(set_mission{moved});
  port.start();
  ASSERT_EQ(port.starts.size(), 1U);
  port.executor_answers(start_verdict::failed, "for another reason");
  moved[1].x += 100;
  port.executor_says(set_mission{moved});
  EXPECT_EQ(port.start(), temporarily_rejected);
  EXPECT_EQ(port.starts.size(), 1U);
}

} // namespace core_start_test
} // namespace godwit::ground_port
