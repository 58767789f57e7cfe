// Plans, their progress and the current item on the ground port.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "io/mavlink/messages/mission_transfer.hpp"
#include "tests/actors/ground_port/port_fixture.hpp"
#include "tests/actors/ground_port/results.hpp"

namespace godwit::ground_port {
namespace core_mission_test {

using namespace test;
using mavlink::mav_cmd;
using mavlink::mav_mission_result;
using mavlink::mav_mission_type;
using mavlink::mav_result;
using mavlink::mission_current;
using mavlink::mission_state;

constexpr auto ack_accepted = mavlink::number(mav_mission_result::accepted);
constexpr auto ack_denied = mavlink::number(mav_mission_result::denied);

mavlink::command_long set_current(float index) { return command(mav_cmd::do_set_mission_current, index); }

void run(port_fixture& port, std::uint16_t current = 0) {
  port.executor_says(
      mission_progress{port.shown().plans[0].plan_id, current, mission_state::active, mavlink::mission_mode::active});
}

void arm(port_fixture& port, bool armed = true) {
  port.vehicle_says(mavlink::heartbeat{.base_mode = static_cast<std::uint8_t>(armed ? 128 : 0)});
}

// -- plans ----------------------------------------------------------------------------------------

TEST(ground_port_core, an_uploaded_mission_is_acknowledged_with_its_id_and_becomes_one_of_the_executor) {
  port_fixture port;
  const auto ack = port.upload(3);
  EXPECT_EQ(ack.type, ack_accepted);
  EXPECT_NE(ack.opaque_id, 0U);
  EXPECT_EQ(ack.target_system, station_id.system);
  ASSERT_EQ(port.taken.size(), 1U);
  EXPECT_EQ(port.taken[0].plan_id, ack.opaque_id);
  EXPECT_EQ(port.taken[0].items.size(), 3U);
  EXPECT_EQ(port.taken[0].by, (executor::station{255, 190}));
}

// As MAVProxy changes an item: `wp changealt`.
mavlink::mission_ack change_item(port_fixture& port, const mavlink::mission_item_int& item, int type = 0,
                                 mavlink::sender from = station_id) {
  mavlink::mission_write_partial_list part;
  part.start_index = part.end_index = static_cast<std::int16_t>(item.seq);
  part.mission_type = static_cast<std::uint8_t>(type);
  port.say(part, from);
  if (!port.sent<mavlink::mission_request_int>().empty() && port.last<mavlink::mission_request_int>().seq == item.seq)
    port.say(item, from);
  return port.last<mavlink::mission_ack>();
}

TEST(ground_port_core, an_item_that_a_station_changes_makes_a_whole_new_mission_of_the_executor) {
  port_fixture port;
  const auto first = port.upload(3);
  auto higher = waypoint(1);
  higher.z = 80;
  port.forget();
  const auto ack = change_item(port, higher);
  EXPECT_EQ(ack.type, ack_accepted);
  ASSERT_EQ(port.taken.size(), 2U);
  EXPECT_NE(port.taken[1].plan_id, first.opaque_id);
  ASSERT_EQ(port.taken[1].items.size(), 3U);
  EXPECT_EQ(port.taken[1].items[1].z, 80);
  EXPECT_EQ(port.taken[1].items[2].z, 50);
}

TEST(ground_port_core, a_station_that_shows_another_mission_changes_no_item_of_it) {
  port_fixture port;
  (void)port.upload(3);
  port.forget();
  EXPECT_EQ(change_item(port, waypoint(1), 0, {254, 190}).type, ack_denied) << "it has never seen it";
  EXPECT_TRUE(port.said("Upload: download the plan first, it has changed"));
  port.executor_says(set_mission{waypoints(5)});
  port.forget();
  EXPECT_EQ(change_item(port, waypoint(1)).type, ack_denied) << "a go-to has changed it";
  (void)port.download();
  port.forget();
  EXPECT_EQ(change_item(port, waypoint(1), 1).type, ack_denied) << "a fence is not changed in part";
  EXPECT_EQ(port.taken.size(), 1U);
}

TEST(ground_port_core, fences_and_rally_points_are_taken_too) {
  port_fixture port;
  std::vector<mavlink::mission_item_int> circle{waypoint(0, 5003)};
  circle[0].param1 = 100;
  EXPECT_EQ(port.upload(circle, 1).type, ack_accepted);
  EXPECT_EQ(port.upload({waypoint(0, 5100)}, 2).type, ack_accepted);
  port.advance(100 * ms);
  EXPECT_NE(port.last<mission_current>().fence_id, 0U);
  EXPECT_NE(port.last<mission_current>().rally_points_id, 0U);
  EXPECT_EQ(port.download(1).size(), 1U);
}

TEST(ground_port_core, the_acknowledgement_waits_for_the_disk) {
  port_fixture port;
  port.slow_disk();
  port.upload(3);
  EXPECT_TRUE(port.sent<mavlink::mission_ack>().empty());
  port.settle_disk();
  EXPECT_EQ(port.last<mavlink::mission_ack>().type, ack_accepted);
}

TEST(ground_port_core, until_then_nobody_is_shown_or_given_the_new_plan) {
  port_fixture port;
  port.upload(3);
  const auto old_id = port.last<mavlink::mission_ack>().opaque_id;
  port.slow_disk();
  port.forget();
  port.upload(5);
  port.advance(2 * s);
  EXPECT_EQ(port.last<mission_current>().mission_id, old_id);
  EXPECT_EQ(port.last<mission_current>().total, 3);
  port.say(mavlink::mission_request_list{}, other_station);
  EXPECT_TRUE(port.sent<mavlink::mission_count>().empty());
  port.settle_disk();
  EXPECT_EQ(port.last<mavlink::mission_count>().count, 5);
}

TEST(ground_port_core, the_last_item_again_is_acknowledged_no_sooner_than_the_first_time) {
  port_fixture port;
  port.slow_disk();
  port.upload(2);
  port.say(waypoint(1));
  EXPECT_TRUE(port.sent<mavlink::mission_ack>().empty());
  port.settle_disk();
  EXPECT_EQ(port.sent<mavlink::mission_ack>().size(), 2U);
}

TEST(ground_port_core, after_a_crash_the_plan_is_served_again_with_the_same_id) {
  port_fixture port;
  auto items = waypoints(3);
  items[0].param4 = NAN;
  items[1].param4 = -NAN;
  items[2].param2 = 0.1F;
  const auto id = port.upload(items).opaque_id;
  port.crash();
  port.advance(1 * s);
  EXPECT_EQ(port.last<mission_current>().mission_id, id);
  const auto read = port.download();
  ASSERT_EQ(read.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(read[i].x, items[i].x);
    EXPECT_EQ(std::bit_cast<std::uint32_t>(read[i].param4), std::bit_cast<std::uint32_t>(items[i].param4));
    EXPECT_EQ(read[i].param2, items[i].param2);
  }
}

TEST(ground_port_core, a_crash_before_the_disk_has_it_leaves_the_old_plan) {
  port_fixture port;
  const auto old_id = port.upload(3).opaque_id;
  port.slow_disk();
  port.upload(5);
  port.crash();
  EXPECT_EQ(port.shown().plans[0].plan_id, old_id);
  EXPECT_EQ(port.download().size(), 3U);
}

TEST(ground_port_core, an_acknowledgement_that_a_crash_has_cut_off_is_sent_by_the_next_life) {
  port_fixture port;
  const auto id = port.upload(3).opaque_id;
  port.forget();
  port.crash(true);
  EXPECT_EQ(port.last<mavlink::mission_ack>().opaque_id, id);
  EXPECT_EQ(port.last<mavlink::mission_ack>().target_system, station_id.system);
}

TEST(ground_port_core, what_the_executor_makes_of_it_is_asked_also_where_a_crash_has_cut_off_the_acknowledgement) {
  port_fixture refused;
  refused.upload(3);
  refused.forget();
  refused.objects = true;
  refused.crash(true);
  EXPECT_EQ(refused.last<mavlink::mission_ack>().type, mavlink::number(mavlink::mav_mission_result::denied));
  port_fixture unknown;
  unknown.upload(3);
  unknown.forget();
  unknown.judges = false;
  unknown.crash(true);
  EXPECT_TRUE(unknown.sent<mavlink::mission_ack>().empty());
  unknown.advance(judged_within_ns);
  EXPECT_EQ(unknown.last<mavlink::mission_ack>().type, mavlink::number(mavlink::mav_mission_result::error));
}

TEST(ground_port_core, an_acknowledgement_that_is_long_overdue_is_not_sent) {
  port_fixture port;
  port.upload(3);
  port.forget();
  port.advance(10 * s);
  port.crash(true);
  EXPECT_TRUE(port.sent<mavlink::mission_ack>().empty());
}

TEST(ground_port_core, a_transfer_in_progress_is_forgotten_by_a_crash) {
  port_fixture port;
  port.say(mavlink::mission_count{.count = 3});
  EXPECT_EQ(port.shown().transfer, "receiving");
  port.crash();
  EXPECT_EQ(port.shown().transfer, "idle");
}

TEST(ground_port_core, clearing_tells_the_executor_and_waits_for_the_disk) {
  port_fixture port;
  port.upload(3);
  port.forget();
  port.slow_disk();
  port.say(mavlink::mission_clear_all{});
  EXPECT_TRUE(port.sent<mavlink::mission_ack>().empty());
  port.settle_disk();
  EXPECT_EQ(port.last<mavlink::mission_ack>().type, ack_accepted);
  ASSERT_EQ(port.cleared.size(), 1U);
  EXPECT_EQ(port.cleared[0].type, mav_mission_type::mission);
  port.crash();
  EXPECT_EQ(port.shown().plans[0].items, 0U);
}

TEST(ground_port_core, clearing_all_types_is_acknowledged_once_when_all_are_on_the_disk) {
  port_fixture port;
  port.upload(3);
  port.upload({waypoint(0, 5100)}, 2);
  port.forget();
  port.say(mavlink::mission_clear_all{.mission_type = 255});
  EXPECT_EQ(port.sent<mavlink::mission_ack>().size(), 1U);
  EXPECT_EQ(port.cleared.size(), 2U);
}

TEST(ground_port_core, clearing_what_is_not_there_is_acknowledged_and_writes_nothing) {
  port_fixture port;
  for (int i = 0; i < 100; ++i)
    port.say(mavlink::mission_clear_all{.mission_type = 1});
  EXPECT_EQ(port.last<mavlink::mission_ack>().type, ack_accepted);
  EXPECT_EQ(port.events, 0U);
}

TEST(ground_port_core, clearing_a_mission_that_no_station_has_brought_still_clears_the_vehicle) {
  port_fixture port;
  port.say(mavlink::mission_clear_all{});
  EXPECT_EQ(port.last<mavlink::mission_ack>().type, ack_accepted);
  EXPECT_EQ(port.cleared.size(), 1U);
}

TEST(ground_port_core, a_mission_that_is_flown_is_not_cleared) {
  port_fixture port;
  port.upload(3);
  arm(port);
  run(port);
  port.say(mavlink::mission_clear_all{});
  EXPECT_EQ(port.last<mavlink::mission_ack>().type, ack_denied);
  port.say(mavlink::mission_count{.count = 0});
  EXPECT_EQ(port.last<mavlink::mission_ack>().type, ack_denied);
  EXPECT_EQ(port.shown().plans[0].items, 3U);
}

TEST(ground_port_core, a_mission_is_not_cleared_in_an_armed_vehicle_while_the_executor_has_not_spoken) {
  port_fixture port;
  EXPECT_EQ(port.upload(3).type, 0);
  port.vehicle_says(mavlink::heartbeat{.base_mode = 128});
  port.say(mavlink::mission_clear_all{});
  EXPECT_EQ(port.last<mavlink::mission_ack>().type, mavlink::number(mavlink::mav_mission_result::denied));
}

TEST(ground_port_core, a_start_item_is_used_up_when_the_mission_runs_whoever_started_it) {
  port_fixture port;
  EXPECT_EQ(port.upload(5).type, 0);
  port.say(mavlink::mission_set_current{.seq = 3});
  port.advance(100 * ms);
  EXPECT_EQ(port.last<mavlink::mission_current>().seq, 3);
  const auto id = port.last<mavlink::mission_current>().mission_id;
  port.executor_says(mission_progress{id, 3, mavlink::mission_state::active, mavlink::mission_mode::active});
  EXPECT_FALSE(port.disk.start_item);
  port.executor_says(mission_progress{id, 4, mavlink::mission_state::complete, mavlink::mission_mode::active});
  port.advance(1 * s);
  EXPECT_EQ(port.last<mavlink::mission_current>().seq, 4);
  EXPECT_EQ(port.last<mavlink::mission_current>().mission_state, mavlink::number(mavlink::mission_state::complete));
}

TEST(ground_port_core, a_mission_that_the_executor_replaces_is_not_read_as_a_mixture) {
  port_fixture port;
  EXPECT_EQ(port.upload(3).type, 0);
  port.say(mavlink::mission_request_list{});
  port.say(mavlink::mission_request_int{.seq = 0});
  port.executor_says(set_mission{waypoints(4)});
  port.forget();
  port.say(mavlink::mission_request_int{.seq = 1});
  EXPECT_TRUE(port.sent<mavlink::mission_item_int>().empty());
}

TEST(ground_port_core, a_mission_is_cleared_while_disarmed_or_not_running) {
  port_fixture port;
  port.upload(3);
  run(port);
  arm(port, false);
  port.say(mavlink::mission_clear_all{});
  EXPECT_EQ(port.last<mavlink::mission_ack>().type, ack_accepted);
  port.upload(3);
  arm(port);
  port.executor_says(mission_progress{port.shown().plans[0].plan_id, 2, mission_state::complete});
  port.say(mavlink::mission_count{.count = 0});
  EXPECT_EQ(port.last<mavlink::mission_ack>().type, ack_accepted);
}

TEST(ground_port_core, a_mission_of_the_executors_is_shown_and_not_told_back_to_it) {
  port_fixture port;
  port.executor_says(set_mission{waypoints(4)});
  port.advance(100 * ms);
  EXPECT_EQ(port.last<mission_current>().total, 4);
  EXPECT_EQ(port.download().size(), 4U);
  EXPECT_TRUE(port.taken.empty());
  port.crash();
  EXPECT_EQ(port.shown().plans[0].items, 4U);
}

TEST(ground_port_core, a_flood_of_uploads_is_bounded_by_what_waits_for_the_disk) {
  port_fixture port;
  port.slow_disk();
  for (int i = 0; i < 100; ++i) {
    port.say(mavlink::mission_count{.count = 1});
    port.say(waypoint(0));
  }
  EXPECT_GT(port.count_of("transfers_dropped"), 0U);
  port.settle_disk();
  EXPECT_LE(port.events, max_waiting_for_disk);
  EXPECT_EQ(port.upload(3).type, ack_accepted) << "it is open again";
}

TEST(ground_port_core, several_stations_take_turns) {
  port_fixture port;
  port.say(mavlink::mission_count{.count = 3});
  port.say(mavlink::mission_count{.count = 2}, other_station);
  EXPECT_EQ(port.last<mavlink::mission_ack>().type, ack_denied);
  EXPECT_EQ(port.last<mavlink::mission_ack>().target_system, other_station.system);
  port.say(mavlink::mission_ack{.type = mavlink::number(mav_mission_result::operation_cancelled)});
  EXPECT_EQ(port.upload(waypoints(2), 0, other_station).type, ack_accepted);
}

TEST(ground_port_core, answers_go_to_the_station_by_the_way_it_came) {
  port_fixture port;
  port.say(start_command(), station_id, 7);
  EXPECT_EQ(port.way_of<mavlink::command_ack>(), 7U);
  port.say(start_command(), other_station, 3);
  EXPECT_EQ(port.way_of<mavlink::command_ack>(), 3U);
  port.say(start_command(), station_id, 8); // it has moved
  EXPECT_EQ(port.way_of<mavlink::command_ack>(), 8U);
}

// -- MISSION_CURRENT ------------------------------------------------------------------------------

TEST(ground_port_core, mission_current_is_told_once_a_second) {
  port_fixture port;
  port.forget();
  port.advance(10 * s);
  EXPECT_EQ(port.sent<mission_current>().size(), 10U);
  EXPECT_EQ(port.last<mission_current>().mission_state, mavlink::number(mission_state::no_mission));
  EXPECT_EQ(port.last<mission_current>().total, 65'535);
}

TEST(ground_port_core, mission_current_has_total_state_mode_and_id) {
  port_fixture port;
  const auto id = port.upload(3).opaque_id;
  port.advance(100 * ms);
  EXPECT_EQ(port.last<mission_current>().total, 3);
  EXPECT_EQ(port.last<mission_current>().mission_id, id);
  EXPECT_EQ(port.last<mission_current>().mission_state, mavlink::number(mission_state::not_started));
  run(port, 1);
  port.advance(100 * ms);
  EXPECT_EQ(port.last<mission_current>().seq, 1);
  EXPECT_EQ(port.last<mission_current>().mission_state, mavlink::number(mission_state::active));
  EXPECT_EQ(port.last<mission_current>().mission_mode, mavlink::number(mavlink::mission_mode::active));
}

TEST(ground_port_core, a_change_is_told_within_100_ms) {
  port_fixture port;
  port.upload(5);
  port.advance(300 * ms);
  for (std::uint16_t i = 1; i < 5; ++i) {
    port.forget();
    run(port, i);
    port.advance(100 * ms);
    ASSERT_EQ(port.sent<mission_current>().size(), 1U);
    EXPECT_EQ(port.last<mission_current>().seq, i);
  }
}

TEST(ground_port_core, progress_of_another_plan_is_not_shown) {
  port_fixture port;
  port.upload(5);
  port.executor_says(mission_progress{12'345, 3, mission_state::active});
  port.advance(1 * s);
  EXPECT_EQ(port.last<mission_current>().seq, 0);
  EXPECT_EQ(port.last<mission_current>().mission_state, mavlink::number(mission_state::not_started));
}

TEST(ground_port_core, the_index_past_the_last_item_is_never_told) {
  port_fixture port;
  port.upload(3);
  run(port, 3);
  port.advance(1 * s);
  EXPECT_EQ(port.last<mission_current>().seq, 2);
}

TEST(ground_port_core, an_item_that_was_reached_is_told_once_and_at_once) {
  port_fixture port;
  port.upload(3);
  port.executor_says(item_reached{1});
  port.advance(5 * s);
  ASSERT_EQ(port.sent<mavlink::mission_item_reached>().size(), 1U);
  EXPECT_EQ(port.last<mavlink::mission_item_reached>().seq, 1);
}

// A process that was killed lets out again what it had not marked as let out.
TEST(ground_port_core, what_was_reached_is_not_told_again_after_a_crash_of_the_executor_or_of_all) {
  port_fixture port;
  port.upload(3);
  const auto reached = [&](std::uint16_t item, bool is_repeated) {
    port.executor_says(item_reached{item, "mission", item + 5U, is_repeated});
  };
  reached(0, false);
  reached(1, false);
  reached(0, true); // the executor alone
  reached(1, true);
  reached(2, true); // it crashed before it was told
  ASSERT_EQ(port.sent<mavlink::mission_item_reached>().size(), 3U);
  port.crash();
  reached(1, true);
  reached(2, true);
  EXPECT_EQ(port.sent<mavlink::mission_item_reached>().size(), 3U);
  port.executor_says(item_reached{0, "another mission", 1, false});
  EXPECT_EQ(port.sent<mavlink::mission_item_reached>().size(), 4U);
}

// -- the current item -----------------------------------------------------------------------------

TEST(ground_port_core, set_current_out_of_range_changes_nothing_and_is_said) {
  port_fixture port;
  port.upload(3);
  for (const float bad : {3.0F, 65'535.0F, 1e20F, -2.0F, 1.5F, NAN}) {
    port.forget();
    port.say(set_current(bad));
    EXPECT_EQ(port.last_result(), denied) << bad;
    port.advance(1 * s);
    EXPECT_FALSE(port.texts().empty()) << bad;
  }
  port.forget();
  port.say(mavlink::mission_set_current{.seq = 3});
  EXPECT_TRUE(port.said("Set current: there is no item 3"));
  EXPECT_EQ(port.disk.start_item, std::nullopt);
}

TEST(ground_port_core, set_current_without_a_mission_is_denied) {
  port_fixture port;
  port.say(set_current(0));
  EXPECT_EQ(port.last_result(), denied);
}

TEST(ground_port_core, set_current_while_idle_is_the_start_item) {
  port_fixture port;
  port.upload(5);
  port.advance(1 * s);
  port.forget();
  port.say(set_current(2));
  EXPECT_EQ(port.last_result(), accepted);
  port.advance(100 * ms);
  EXPECT_EQ(port.last<mission_current>().seq, 2);
  EXPECT_TRUE(port.set_currents.empty());
  port.say(start_command());
  EXPECT_EQ(port.starts.back().first, 2);
}

TEST(ground_port_core, a_start_that_names_an_item_goes_there_and_not_to_the_start_item) {
  port_fixture port;
  port.upload(5);
  port.say(set_current(2));
  port.say(start_command(1));
  EXPECT_EQ(port.starts.back().first, 1);
}

TEST(ground_port_core, a_start_item_is_used_once) {
  port_fixture port;
  port.upload(5);
  port.say(set_current(2));
  port.say(start_command());
  port.executor_answers(executor::start_verdict::started);
  port.advance(5 * s);
  port.say(start_command());
  EXPECT_EQ(port.starts.back().first, 0);
  EXPECT_EQ(port.disk.start_item, std::nullopt);
}

TEST(ground_port_core, a_start_item_is_answered_when_it_is_on_the_disk_and_survives_a_crash) {
  port_fixture port;
  port.upload(5);
  port.slow_disk();
  port.forget();
  port.say(set_current(2));
  port.advance(1 * s);
  EXPECT_EQ(port.last_result(), -1);
  EXPECT_EQ(port.last<mission_current>().seq, 0);
  port.settle_disk();
  EXPECT_EQ(port.last_result(), accepted);
  port.crash();
  port.advance(1 * s);
  EXPECT_EQ(port.last<mission_current>().seq, 2);
}

TEST(ground_port_core, what_an_earlier_life_wrote_late_does_not_count_for_this_one) {
  port_fixture port;
  port.upload(5);
  port.say(set_current(2));
  port.forget();
  port.crash();
  port.slow_disk();
  port.upload(4);
  port.dispatch_effect_last_again(); // its write came late: the answer to the start item is owed
  EXPECT_EQ(port.last_result(), accepted);
  EXPECT_TRUE(port.sent<mavlink::mission_ack>().empty());
  port.settle_disk();
  EXPECT_EQ(port.last<mavlink::mission_ack>().type, ack_accepted);
}

TEST(ground_port_core, a_new_mission_has_no_start_item_but_the_one_that_it_marks) {
  port_fixture port;
  port.upload(5);
  port.say(set_current(2));
  port.upload(4);
  port.advance(1 * s);
  EXPECT_EQ(port.last<mission_current>().seq, 0);
  auto items = waypoints(6);
  items[3].current = 1;
  port.upload(items);
  port.advance(1 * s);
  EXPECT_EQ(port.last<mission_current>().seq, 3);
}

TEST(ground_port_core, mission_set_current_is_confirmed_by_mission_current) {
  port_fixture port;
  port.upload(5);
  port.advance(300 * ms);
  port.forget();
  port.say(mavlink::mission_set_current{.seq = 4});
  port.advance(100 * ms);
  EXPECT_EQ(port.last<mission_current>().seq, 4);
  port.forget();
  port.say(mavlink::mission_set_current{.seq = 4}); // again: there is nothing to change
  EXPECT_EQ(port.last<mission_current>().seq, 4);
  EXPECT_TRUE(port.sent<mavlink::command_ack>().empty());
}

TEST(ground_port_core, set_current_while_paused_is_where_the_mission_goes_on) {
  const auto paused_at_3 = [](port_fixture& port) {
    port.upload(5);
    port.vehicle_says(mavlink::heartbeat{.base_mode = 128});
    port.executor_says(mission_progress{port.shown().plans[0].plan_id, 1, mavlink::mission_state::paused});
    port.say(set_current(3));
    EXPECT_EQ(port.last_result(), accepted);
    EXPECT_TRUE(port.set_currents.empty()) << "nothing goes there now";
    port.advance(1 * s);
    EXPECT_EQ(port.last<mission_current>().seq, 3);
    EXPECT_EQ(port.last<mission_current>().mission_state, mavlink::number(mavlink::mission_state::paused));
  };
  port_fixture started;
  paused_at_3(started);
  started.say(start_command());
  ASSERT_EQ(started.starts.size(), 1U);
  EXPECT_EQ(started.starts[0].first, 3);
  port_fixture continued;
  paused_at_3(continued);
  continued.say(command(mavlink::mav_cmd::do_pause_continue, 1));
  ASSERT_EQ(continued.starts.size(), 1U);
  EXPECT_EQ(continued.starts[0].first, 3);
  EXPECT_TRUE(continued.words.empty());
  continued.executor_answers(executor::start_verdict::started);
  EXPECT_EQ(continued.last<mavlink::command_ack>().command, mavlink::number(mavlink::mav_cmd::do_pause_continue));
  EXPECT_EQ(continued.last_result(), accepted);
}

TEST(ground_port_core, set_current_while_running_asks_the_executor_to_go_there_now) {
  port_fixture port;
  port.upload(5);
  run(port, 1);
  port.forget();
  port.say(set_current(3));
  EXPECT_EQ(port.last_result(), -1);
  ASSERT_EQ(port.set_currents.size(), 1U);
  EXPECT_EQ(port.set_currents[0].what.index, 3);
  port.executor_says(executor::current_answer{executor::current_verdict::going, ""});
  EXPECT_EQ(port.last_result(), accepted);
}

TEST(ground_port_core, what_the_executor_refuses_is_refused_with_its_reason) {
  port_fixture port;
  port.upload(5);
  run(port, 1);
  port.say(set_current(3));
  port.executor_says(executor::current_answer{executor::current_verdict::not_now, "a pilot has the vehicle"});
  EXPECT_EQ(port.last_result(), static_cast<int>(mav_result::temporarily_rejected));
  port.advance(1 * s);
  EXPECT_TRUE(port.said("Set current: a pilot has the vehicle"));
  port.say(set_current(3));
  port.executor_fails_to_answer("the executor is not running");
  port.advance(1 * s);
  EXPECT_TRUE(port.said("Set current: the executor is not running"));
}

TEST(ground_port_core, set_current_again_while_the_executor_works_is_not_given_to_it_again) {
  port_fixture port;
  port.upload(5);
  run(port, 1);
  port.say(set_current(3));
  port.say(set_current(3));
  EXPECT_EQ(port.last_result(), static_cast<int>(mav_result::in_progress));
  port.say(set_current(2), other_station);
  EXPECT_EQ(port.last_result(), static_cast<int>(mav_result::temporarily_rejected));
  EXPECT_EQ(port.set_currents.size(), 1U);
}

TEST(ground_port_core, minus_1_keeps_the_current_item) {
  port_fixture port;
  port.upload(5);
  port.say(set_current(2));
  port.say(set_current(-1));
  EXPECT_EQ(port.last_result(), accepted);
  EXPECT_EQ(port.disk.start_item, 2);
}

// -- what the executor makes of an upload -----------------------------------------------------------

TEST(ground_port_plans, an_upload_that_the_executor_does_not_take_is_denied_and_the_plan_from_before_stays) {
  port_fixture port;
  const auto first = port.upload(3);
  ASSERT_EQ(first.type, 0);
  port.objects = true;
  EXPECT_EQ(port.upload(5).type, mavlink::number(mavlink::mav_mission_result::denied));
  EXPECT_EQ(port.download().size(), 3U);
  EXPECT_EQ(port.shown().plans[0].plan_id, first.opaque_id);
  EXPECT_EQ(port.disk.plans.at(0).items.size(), 3U);
  EXPECT_EQ(port.count_of("plans_refused"), 1U);
}

TEST(ground_port_plans, an_upload_for_which_the_vehicle_has_no_room_is_answered_so_and_the_plan_from_before_stays) {
  port_fixture port;
  ASSERT_EQ(port.upload(3).type, 0);
  port.judges = false;
  EXPECT_EQ(port.upload(900).type, 0xFF) << "no answer yet";
  const auto plan = port.taken.back();
  port.judge({plan.type, plan.plan_id, plan_verdict::bringing});
  port.advance(500 * ms);
  EXPECT_EQ(port.sent<mavlink::mission_ack>().size(), 1U);
  port.judge({plan.type, plan.plan_id, plan_verdict::no_space});
  EXPECT_EQ(port.last<mavlink::mission_ack>().type, mavlink::number(mavlink::mav_mission_result::no_space));
  EXPECT_EQ(port.shown().plans[0].items, 3U);
  port.advance(s);
  EXPECT_FALSE(port.said("Mission: 900 items taken from 255/190"));
}

TEST(ground_port_plans, an_upload_is_not_accepted_before_the_executor_has_taken_it) {
  port_fixture port;
  port.judges = false;
  EXPECT_EQ(port.upload(3).type, 0xFF) << "no answer yet";
  port.advance(500 * ms);
  EXPECT_TRUE(port.sent<mavlink::mission_ack>().empty());
  const auto plan = port.taken.back();
  port.judge({plan.type, plan.plan_id, plan_verdict::taken});
  EXPECT_EQ(port.last<mavlink::mission_ack>().type, 0);
}

TEST(ground_port_plans, a_plan_that_goes_to_a_vehicle_in_flight_is_waited_for_until_it_is_there_or_not) {
  for (const auto last_word : {plan_verdict::taken, plan_verdict::refused}) {
    port_fixture port;
    const auto before = port.upload(2);
    port.judges = false;
    (void)port.upload(3);
    port.forget();
    const auto plan = port.taken.back();
    port.judge({plan.type, plan.plan_id, plan_verdict::bringing});
    port.advance(10 * s);
    EXPECT_TRUE(port.sent<mavlink::mission_ack>().empty());
    EXPECT_EQ(port.shown().plans[0].plan_id, before.opaque_id) << "what is flown";
    port.judge({plan.type, plan.plan_id, last_word});
    const bool is_taken = last_word == plan_verdict::taken;
    EXPECT_EQ(port.last<mavlink::mission_ack>().type, is_taken ? ack_accepted : ack_denied);
    EXPECT_EQ(port.shown().plans[0].plan_id, is_taken ? plan.plan_id : before.opaque_id);
  }
}

TEST(ground_port_plans, a_vehicle_in_flight_that_is_never_heard_of_again_is_an_error) {
  port_fixture port;
  port.judges = false;
  (void)port.upload(3);
  port.forget();
  const auto plan = port.taken.back();
  port.judge({plan.type, plan.plan_id, plan_verdict::bringing});
  port.advance(brought_within_ns);
  EXPECT_EQ(port.last<mavlink::mission_ack>().type, mavlink::number(mavlink::mav_mission_result::error));
}

TEST(ground_port_plans, an_executor_that_does_not_answer_is_an_error_and_not_an_acceptance) {
  port_fixture port;
  port.judges = false;
  (void)port.upload(3);
  port.advance(judged_within_ns);
  EXPECT_EQ(port.last<mavlink::mission_ack>().type, mavlink::number(mavlink::mav_mission_result::error));
}

// -- what the executor makes of a clear -------------------------------------------------------------

TEST(ground_port_plans, a_clear_that_the_executor_refuses_is_denied_and_the_plan_is_still_shown) {
  port_fixture port;
  const auto before = port.upload(3);
  port.forget();
  port.objects = true;
  port.say(mavlink::mission_clear_all{});
  ASSERT_EQ(port.sent<mavlink::mission_ack>().size(), 1U);
  EXPECT_EQ(port.last<mavlink::mission_ack>().type, ack_denied);
  EXPECT_EQ(port.download().size(), 3U);
  EXPECT_EQ(port.shown().plans[0].plan_id, before.opaque_id);
  EXPECT_EQ(port.disk.plans.at(0).items.size(), 3U);
}

TEST(ground_port_plans, a_clear_is_answered_once_when_the_vehicle_has_obeyed_it_however_often_it_is_said) {
  port_fixture port;
  port.upload(3);
  port.forget();
  port.judges = false;
  for (int i = 0; i < 3; ++i) {
    port.say(mavlink::mission_clear_all{});
    port.advance(1 * s);
  }
  EXPECT_TRUE(port.sent<mavlink::mission_ack>().empty());
  EXPECT_EQ(port.cleared.size(), 1U) << "the executor is asked once";
  port.judge({mav_mission_type::mission, 0, plan_verdict::taken});
  ASSERT_EQ(port.sent<mavlink::mission_ack>().size(), 1U);
  EXPECT_EQ(port.last<mavlink::mission_ack>().type, ack_accepted);
}

TEST(ground_port_plans, a_vehicle_that_does_not_clear_is_an_error_and_the_station_has_no_plan) {
  port_fixture port;
  port.upload(3);
  port.judges = false;
  port.say(mavlink::mission_clear_all{});
  port.judge({mav_mission_type::mission, 0, plan_verdict::failed});
  EXPECT_EQ(port.last<mavlink::mission_ack>().type, mavlink::number(mavlink::mav_mission_result::error));
  EXPECT_EQ(port.shown().plans[0].items, 0U);
}

TEST(ground_port_plans, a_clear_without_an_answer_is_an_error_and_not_an_acceptance) {
  port_fixture port;
  port.upload(3);
  port.judges = false;
  port.say(mavlink::mission_clear_all{});
  port.forget();
  port.advance(cleared_within_ns);
  EXPECT_EQ(port.last<mavlink::mission_ack>().type, mavlink::number(mavlink::mav_mission_result::error));
}

TEST(ground_port_plans, clearing_all_types_is_denied_when_one_of_them_is_and_that_one_stays) {
  port_fixture port;
  port.upload(3);
  port.upload({waypoint(0, 5100)}, 2);
  port.forget();
  port.judges = false;
  port.say(mavlink::mission_clear_all{.mission_type = 255});
  port.judge({mav_mission_type::mission, 0, plan_verdict::refused});
  EXPECT_TRUE(port.sent<mavlink::mission_ack>().empty()) << "the other one is not known yet";
  port.judge({mav_mission_type::rally, 0, plan_verdict::taken});
  EXPECT_EQ(port.last<mavlink::mission_ack>().type, ack_denied);
  EXPECT_EQ(port.shown().plans[0].items, 3U);
  EXPECT_EQ(port.shown().plans[2].items, 0U);
}

// Found with MAVSDK: DENIED, and then the text "Mission: 4 items taken".
TEST(ground_port_plans, no_text_says_that_a_plan_is_taken_which_is_refused) {
  port_fixture port;
  port.objects = true;
  EXPECT_NE(port.upload(4).type, 0);
  port.advance(s);
  for (const auto& each : port.texts())
    EXPECT_EQ(each.find("taken from"), std::string::npos) << each;
  port.objects = false;
  EXPECT_EQ(port.upload(4).type, 0);
  port.advance(s);
  EXPECT_TRUE(port.said("Mission: 4 items taken from 255/190"));
}

} // namespace core_mission_test
} // namespace godwit::ground_port
