// Uploads in whole exchanges, with the turns of the vehicles: as PX4 1.17 and ArduPilot 4.7 were seen to
// answer on the wire, and as our own server does where they differ.
#include "actors/ground_port/mission_server/server.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include <gtest/gtest.h>

#include "tests/actors/ground_port/mission_server/plan_types.hpp"
#include "tests/actors/ground_port/mission_server/server_fixture.hpp"

namespace godwit::ground_port::mission_server::test {
namespace server_upload_test {

using mavlink::mav_mission_result;
using mavlink::number;
using words = dialogue::words;

mavlink::mission_item float_waypoint(int seq) {
  mavlink::mission_item item;
  item.seq = static_cast<std::uint16_t>(seq);
  item.command = number(mavlink::mav_cmd::nav_waypoint);
  item.frame = number(mavlink::mav_frame::global_relative_alt);
  item.x = 50;
  item.y = 36.5F;
  return item;
}

words times(int count, const std::string& text) { return words(static_cast<std::size_t>(count), text); }

// -- Silence

TEST(server_upload, our_own_server_asks_again_in_both_ways_by_turns) {
  dialogue with(plain_profile());
  EXPECT_EQ(with.tell(count_of(2)), words{"REQUEST_INT 0"});
  EXPECT_EQ(with.wait(1 * s), words{"REQUEST 0"});
  EXPECT_EQ(with.wait(1 * s), words{"REQUEST_INT 0"});
}

TEST(server_upload, px4_asks_again_every_260_ms_and_stops_after_5_s_without_a_word) {
  dialogue with(px4_profile());
  (void)with.tell(count_of(3));
  EXPECT_EQ(with.wait(260 * ms - 1), words());
  EXPECT_EQ(with.wait(1), words{"REQUEST_INT 0"});
  EXPECT_EQ(with.wait(4'740 * ms - 1), times(18, "REQUEST_INT 0"));
  EXPECT_TRUE(with.vehicle().is_receiving());
  EXPECT_EQ(with.wait(1), words());
  EXPECT_TRUE(with.vehicle().is_idle());
  EXPECT_EQ(with.wait(60 * s), words());
}

TEST(server_upload, ardupilot_asks_again_every_second_and_cancels_after_8_s) {
  for (const auto& vehicle : {ardupilot_copter_profile(), ardupilot_plane_profile(), ardupilot_rover_profile()}) {
    dialogue with(vehicle);
    EXPECT_EQ(with.tell(count_of(3)), words{"REQUEST 0"});
    EXPECT_EQ(with.wait(1 * s - with.since_turn_ns() - 1), words());
    EXPECT_EQ(with.wait(1), words{"REQUEST 0"});
    EXPECT_EQ(with.wait(7 * s - 1), times(6, "REQUEST 0"));
    EXPECT_EQ(with.wait(1), words{"ACK operation_cancelled"});
    EXPECT_TRUE(with.vehicle().is_idle());
    EXPECT_EQ(with.wait(60 * s), words());
  }
}

// ArduRover 4.7, at a replan: COUNT and six items at 9.888, REQUEST 1 to 5 and the ACK at 9.892.
TEST(server_upload, ardupilot_never_asks_for_an_item_that_came_ahead_of_its_first_request) {
  for (const auto& vehicle : {ardupilot_copter_profile(), ardupilot_plane_profile(), ardupilot_rover_profile()}) {
    dialogue with(vehicle);
    with.send(count_of(3));
    for (const int each : {0, 1, 2})
      with.send(waypoint(each));
    EXPECT_EQ(with.wait(5 * vehicle.turn_ns), (words{"REQUEST 1", "REQUEST 2", "ACK accepted"}));
  }
}

TEST(server_upload, patience_begins_again_with_each_item_and_asks_for_the_one_that_is_missing) {
  dialogue with(px4_profile());
  (void)with.tell(count_of(3));
  (void)with.wait(4'900 * ms);
  EXPECT_EQ(with.tell(waypoint(0)), words{"REQUEST_INT 1"});
  EXPECT_EQ(with.wait(4'999 * ms), times(19, "REQUEST_INT 1"));
  EXPECT_EQ(with.tell(waypoint(1)), words{"REQUEST_INT 2"});
  EXPECT_EQ(with.tell(waypoint(2)), words{"ACK accepted"});
}

// -- Order

TEST(server_upload, px4_says_nothing_to_a_wrong_item_and_asks_in_its_own_time) {
  dialogue with(px4_profile());
  (void)with.tell(count_of(3));
  EXPECT_EQ(with.tell(waypoint(1)), words());
  EXPECT_EQ(with.wait(260 * ms), words{"REQUEST_INT 0"});
  (void)with.tell(waypoint(0));
  EXPECT_EQ(with.tell(waypoint(0)), words()) << "it has it";
  EXPECT_EQ(with.wait(260 * ms), words{"REQUEST_INT 1"});
}

TEST(server_upload, ardupilot_answers_each_item_after_a_gap_and_then_goes_on_with_the_right_one) {
  dialogue with(ardupilot_copter_profile());
  (void)with.tell(count_of(17));
  for (int seq = 1; seq < 17; ++seq)
    with.send(waypoint(seq));
  EXPECT_EQ(with.wait(40 * ms), times(16, "ACK invalid_sequence"));
  for (int seq = 0; seq < 16; ++seq)
    EXPECT_EQ(with.tell(waypoint(seq)), words{"REQUEST " + std::to_string(seq + 1)});
  EXPECT_EQ(with.tell(waypoint(16)), words{"ACK accepted"});
  EXPECT_EQ(with.held().items.size(), 17U);
}

TEST(server_upload, the_last_item_again_is_accepted_from_its_station_alone_and_in_each_form) {
  dialogue with(px4_profile());
  EXPECT_EQ(with.upload(3), words{"ACK accepted"});
  EXPECT_EQ(with.tell(waypoint(2)), words{"ACK accepted"});
  EXPECT_EQ(with.tell(float_waypoint(2)), words{"ACK accepted"});
  EXPECT_EQ(with.tell(waypoint(1)), words{"ACK error"}) << "not the last";
  EXPECT_EQ(with.tell(waypoint(2, fence)), words{"ACK error type 1"}) << "not this plan";
  EXPECT_EQ(with.tell(waypoint(2), other_station), words{"254/190 ACK error"});
  EXPECT_EQ(with.changes().size(), 1U) << "and the plan has come once";
  (void)with.tell(count_of(0));
  EXPECT_EQ(with.tell(waypoint(2)), words{"ACK error"}) << "the plan is no longer there";
}

TEST(server_upload, ardupilot_and_our_server_begin_again_with_the_new_count_and_px4_goes_on_with_the_old_one) {
  for (const auto& [vehicle, answer, count] : {std::tuple{ardupilot_rover_profile(), "REQUEST 0", 2},
                                               {plain_profile(), "REQUEST_INT 0", 2},
                                               {px4_profile(), "ACK error", 4}}) {
    dialogue with(vehicle);
    (void)with.tell(count_of(4));
    (void)with.tell(waypoint(0));
    (void)with.tell(waypoint(1));
    EXPECT_EQ(with.tell(count_of(2)), words{answer});
    for (int seq = count == 2 ? 0 : 2; seq < count - 1; ++seq)
      (void)with.tell(waypoint(seq));
    EXPECT_EQ(with.tell(waypoint(count - 1)), words{"ACK accepted"});
    EXPECT_EQ(with.held().items.size(), static_cast<std::size_t>(count));
  }
}

TEST(server_upload, px4_takes_a_new_count_before_item_0_for_the_old_one_again) {
  dialogue with(px4_profile());
  (void)with.tell(count_of(2));
  EXPECT_EQ(with.tell(count_of(5, fence)), words{"REQUEST_INT 0"});
  (void)with.tell(waypoint(0));
  EXPECT_EQ(with.tell(waypoint(1)), words{"ACK accepted"});
}

TEST(server_upload, a_refused_count_ends_the_upload_of_its_station_with_us_and_with_no_autopilot) {
  for (const auto& refused : {count_of(60'000), count_of(3, 7)}) {
    dialogue with(plain_profile());
    (void)with.tell(count_of(2));
    (void)with.tell(waypoint(0));
    (void)with.tell(refused);
    EXPECT_TRUE(with.vehicle().is_idle());
    EXPECT_EQ(with.tell(waypoint(1)), words{"ACK error"});
    dialogue ardupilot(ardupilot_copter_profile());
    (void)ardupilot.tell(count_of(2));
    (void)ardupilot.tell(waypoint(0));
    (void)ardupilot.tell(refused);
    EXPECT_EQ(ardupilot.tell(waypoint(1)), words{"ACK accepted"});
  }
  dialogue flown(plain_profile());
  (void)flown.upload(2);
  flown.vehicle().lock(true);
  (void)flown.tell(count_of(2));
  EXPECT_EQ(flown.tell(count_of(0)), words{"ACK denied"});
  EXPECT_TRUE(flown.vehicle().is_idle());
  EXPECT_EQ(flown.held().items.size(), 2U);
}

// -- Turns

// 100 items were seen to take 2.02 s on Rover and 0.44 s on Copter, request by request; what is sent ahead waits for
// its turn and for nothing else.
TEST(server_upload, ninety_items_at_once_take_a_turn_each_and_one_for_the_count) {
  for (const auto& vehicle : {ardupilot_rover_profile(), ardupilot_copter_profile()}) {
    dialogue with(vehicle);
    with.send(count_of(90));
    for (int seq = 0; seq < 90; ++seq)
      with.send(waypoint(seq));
    const auto first_turn_ns = with.vehicle().next_deadline_ns();
    EXPECT_EQ(with.wait(first_turn_ns + 90 * vehicle.turn_ns - 1 - with.now_ns()).size(), 89U) << "all requests";
    EXPECT_EQ(with.wait(1), words{"ACK accepted"});
  }
}

TEST(server_upload, a_flood_costs_the_newest_messages_and_nothing_else) {
  dialogue with(ardupilot_rover_profile());
  (void)with.tell(count_of(3));
  for (int i = 0; i < 200; ++i)
    with.send(waypoint(2));
  EXPECT_EQ(with.vehicle().dropped(), 200 - max_waiting_messages);
  const auto answers = with.wait(3 * s);
  EXPECT_EQ(static_cast<std::size_t>(std::count(answers.begin(), answers.end(), "ACK invalid_sequence")),
            max_waiting_messages)
      << "each that was taken is answered";
  EXPECT_EQ(with.upload(3), words{"ACK accepted"});
}

// -- Room, commands, frames, types

TEST(server_upload, px4_and_ardupilot_have_no_space_for_60000_items_and_keep_what_they_hold) {
  for (const auto& vehicle : {px4_profile(), ardupilot_copter_profile()}) {
    dialogue with(vehicle);
    (void)with.upload(3);
    EXPECT_EQ(with.tell(count_of(60'000)), words{"ACK no_space"});
    EXPECT_EQ(with.tell(count_of(60'000, fence)), words{"ACK no_space type 1"});
    EXPECT_TRUE(with.vehicle().is_idle());
    EXPECT_EQ(with.held().items.size(), 3U);
  }
}

TEST(server_upload, an_unknown_command_or_frame_ends_the_transfer_with_its_reason) {
  auto command = waypoint(1);
  command.command = 9'999;
  auto frame = waypoint(1);
  frame.frame = 77;
  for (const auto& vehicle : {px4_profile(), ardupilot_copter_profile(), plain_profile()}) {
    for (const auto& [bad, answer] : {std::pair{command, "ACK unsupported"}, {frame, "ACK unsupported_frame"}}) {
      dialogue with(vehicle);
      (void)with.tell(count_of(3));
      (void)with.tell(waypoint(0));
      EXPECT_EQ(with.tell(bad), words{answer});
      EXPECT_EQ(with.wait(60 * s), words()) << "nothing is asked for any more";
      EXPECT_TRUE(resolved(with.changes()).empty());
    }
  }
}

TEST(server_upload, an_item_of_another_type_is_an_error_and_does_not_count) {
  for (const auto& vehicle : {px4_profile(), ardupilot_copter_profile()}) {
    dialogue with(vehicle);
    (void)with.tell(count_of(2));
    EXPECT_EQ(with.tell(waypoint(0, rally)), words{"ACK error type 2"});
    (void)with.tell(waypoint(0));
    EXPECT_EQ(with.tell(waypoint(1)), words{"ACK accepted"});
    EXPECT_TRUE(with.held(rally).items.empty());
  }
}

TEST(server_upload, a_plan_of_no_known_type_is_not_begun) {
  for (const int type : {7, all})
    for (const auto& vehicle : {px4_profile(), ardupilot_copter_profile(), plain_profile()}) {
      dialogue with(vehicle);
      const std::string answer = vehicle.checks_type ? "ACK unsupported type " : "ACK no_space type ";
      EXPECT_EQ(with.tell(count_of(3, type)), words{answer + std::to_string(type)});
      EXPECT_TRUE(with.vehicle().is_idle());
    }
}

// -- The deprecated form

TEST(server_upload, float_items_make_a_plan_on_px4_and_ardupilot) {
  for (const auto& vehicle : {px4_profile(), ardupilot_copter_profile()}) {
    dialogue with(vehicle);
    (void)with.tell(count_of(3));
    EXPECT_EQ(with.tell(float_waypoint(0)), words{"REQUEST 1"});
    EXPECT_EQ(with.wait(1 * s).front(), "REQUEST 1") << "asked for in that form from now on";
    EXPECT_EQ(with.tell(float_waypoint(1)), words{"REQUEST 2"});
    EXPECT_EQ(with.tell(waypoint(2)), words{"ACK accepted"}) << "the other one is as good";
    EXPECT_EQ(with.held().items.at(1).x, 500'000'000);
    EXPECT_EQ(with.held().items.at(1).y, 365'000'000);
  }
}

TEST(server_upload, our_own_server_asks_for_integers_and_does_not_hear_floats) {
  dialogue with(plain_profile());
  (void)with.tell(count_of(2));
  EXPECT_EQ(with.tell(float_waypoint(0)), words());
  EXPECT_EQ(with.wait(2 * s), (words{"REQUEST 0", "REQUEST_INT 0"}));
}

// -- Several stations

TEST(server_upload, an_item_of_a_station_that_is_refused_never_comes_into_the_plan_of_the_other) {
  for (const auto& vehicle : {px4_profile(), ardupilot_copter_profile(), plain_profile()}) {
    dialogue with(vehicle);
    (void)with.tell(count_of(2));
    auto foreign = waypoint(0);
    foreign.x = 77;
    (void)with.tell(count_of(2), other_station);
    (void)with.tell(foreign, other_station);
    EXPECT_EQ(with.held().items.size(), 0U);
    (void)with.tell(waypoint(0));
    foreign.seq = 1;
    (void)with.tell(foreign, other_station);
    EXPECT_EQ(with.tell(waypoint(1)), words{"ACK accepted"});
    EXPECT_EQ(with.held().items.at(1).x, waypoint(1).x);
  }
}

TEST(server_upload, nothing_that_another_station_says_ends_or_lengthens_a_transfer) {
  dialogue with(px4_profile());
  (void)with.tell(count_of(2));
  (void)with.wait(4'900 * ms);
  for (const auto& answer : {with.tell(ack_of(mav_mission_result::operation_cancelled), other_station),
                             with.tell(request_for<mavlink::mission_request_int>(0), other_station)})
    EXPECT_EQ(answer, words());
  EXPECT_EQ(with.tell(clear_of(0), other_station), words{"254/190 ACK error"});
  EXPECT_EQ(with.tell(count_of(0), other_station), words{"254/190 ACK error"});
  EXPECT_EQ(with.tell(list_of(0), other_station), words());
  EXPECT_TRUE(with.vehicle().is_receiving());
  (void)with.wait(100 * ms);
  EXPECT_TRUE(with.vehicle().is_idle());
}

TEST(server_upload, one_station_after_the_other_and_each_change_names_its_author) {
  dialogue with(ardupilot_rover_profile());
  EXPECT_EQ(with.upload(2), words{"ACK accepted"});
  EXPECT_EQ(with.upload(3, 0, other_station), words{"254/190 ACK accepted"});
  (void)with.tell(count_of(0));
  const auto changes = resolved(with.changes());
  ASSERT_EQ(changes.size(), 3U);
  EXPECT_EQ(changes[0].by, station);
  EXPECT_EQ(changes[1].by, other_station);
  EXPECT_EQ(changes[1].count, 3);
  EXPECT_EQ(changes[2].by, station);
  EXPECT_EQ(changes[2].count, 0);
}

TEST(server_upload, what_is_for_another_vehicle_leaves_no_trace) {
  for (const auto& vehicle : {px4_profile(), ardupilot_copter_profile(), plain_profile()}) {
    dialogue with(vehicle);
    (void)with.upload(2);
    const mavlink::sender neighbour{2, 1};
    EXPECT_EQ(with.tell(count_of(0), station, neighbour), words());
    EXPECT_EQ(with.tell(clear_of(all), station, neighbour), words());
    EXPECT_EQ(with.tell(count_of(3), station, neighbour), words());
    EXPECT_EQ(with.tell(waypoint(1), station, neighbour), words());
    EXPECT_TRUE(with.vehicle().is_idle());
    EXPECT_EQ(with.held().items.size(), 2U);
  }
}

// -- Cancel

TEST(server_upload, ardupilot_does_not_hear_a_cancel_and_cancels_itself_8_s_after_the_last_item) {
  dialogue with(ardupilot_copter_profile());
  (void)with.tell(count_of(3));
  (void)with.tell(waypoint(0));
  EXPECT_EQ(with.tell(ack_of(mav_mission_result::operation_cancelled)), words());
  auto rest = with.wait(8 * s);
  ASSERT_EQ(rest.size(), 8U);
  EXPECT_EQ(rest.back(), "ACK operation_cancelled");
  rest.pop_back();
  EXPECT_EQ(rest, times(7, "REQUEST 1"));
}

TEST(server_upload, another_acknowledgement_is_no_cancel) {
  dialogue with(px4_profile());
  (void)with.tell(count_of(3));
  EXPECT_EQ(with.tell(ack_of(mav_mission_result::accepted)), words());
  EXPECT_TRUE(with.vehicle().is_receiving());
}

// -- What is held when an upload does not end

TEST(server_upload, an_atomic_vehicle_holds_the_old_plan_however_the_new_one_ends) {
  auto bad = waypoint(1);
  bad.command = 9'999;
  for (const auto& vehicle : {px4_profile(), plain_profile()})
    for (const int ending : {0, 1, 2}) {
      dialogue with(vehicle);
      (void)with.upload(4);
      const auto id = with.held().id;
      (void)with.tell(count_of(3));
      (void)with.tell(waypoint(0));
      EXPECT_EQ(with.held().items.size(), 4U);
      if (ending == 0)
        (void)with.tell(ack_of(mav_mission_result::operation_cancelled));
      else if (ending == 1)
        (void)with.tell(bad);
      else
        (void)with.wait(5 * s);
      EXPECT_TRUE(with.vehicle().is_idle());
      EXPECT_EQ(with.held().items.size(), 4U);
      EXPECT_EQ(with.held().id, id);
      EXPECT_EQ(with.changes().size(), 1U);
    }
}

TEST(server_upload, ardupilot_holds_the_beginning_of_the_new_plan_and_the_rest_of_the_old_one) {
  dialogue with(ardupilot_copter_profile());
  (void)with.upload(4);
  (void)with.tell(count_of(3));
  for (int seq = 0; seq < 2; ++seq) {
    auto moved = waypoint(seq);
    moved.x += 1'000;
    (void)with.tell(moved);
  }
  (void)with.wait(8 * s);
  const auto& items = with.held().items;
  ASSERT_EQ(items.size(), 3U);
  EXPECT_EQ(items.at(1).x, waypoint(1).x + 1'000);
  EXPECT_EQ(items.at(2).x, waypoint(2).x);
}

// -- Plan ids

TEST(server_upload, px4_and_our_server_name_each_plan_by_its_content) {
  for (const auto& vehicle : {px4_profile(), plain_profile()}) {
    dialogue with(vehicle);
    for (const int type : {0, fence, rally}) {
      (void)with.upload(3, type);
      const auto id = with.last<mavlink::mission_ack>().opaque_id;
      EXPECT_NE(id, 0U);
      EXPECT_EQ(with.held(type).id, id);
      EXPECT_EQ(with.changes().back().plan_id, id);
      (void)with.upload(2, type);
      EXPECT_NE(with.last<mavlink::mission_ack>().opaque_id, id);
      (void)with.upload(3, type, other_station);
      EXPECT_EQ(with.last<mavlink::mission_ack>().opaque_id, id);
      (void)with.tell(list_of(type));
      EXPECT_EQ(with.last<mavlink::mission_count>().opaque_id, id);
      (void)with.tell(ack_of(mav_mission_result::accepted, type));
    }
  }
}

TEST(server_upload, an_answer_that_accepts_no_plan_has_no_id) {
  dialogue with(px4_profile());
  const auto id_after = [&](const auto& message) {
    EXPECT_EQ(with.tell(message).size(), 1U);
    return with.last<mavlink::mission_ack>().opaque_id;
  };
  (void)with.upload(3);
  EXPECT_EQ(id_after(count_of(60'000)), 0U);
  EXPECT_EQ(id_after(waypoint(0)), 0U);
  EXPECT_NE(id_after(waypoint(2)), 0U) << "the last item again: what was accepted";
  EXPECT_EQ(id_after(count_of(0)), 0U);
  EXPECT_EQ(with.held().id, 0U);
}

TEST(server_upload, ardupilot_has_no_ids) {
  dialogue with(ardupilot_copter_profile());
  for (const int type : {0, fence, rally}) {
    EXPECT_EQ(with.upload(3, type).size(), 1U);
    EXPECT_EQ(with.last<mavlink::mission_ack>().opaque_id, 0U);
    (void)with.tell(list_of(type));
    EXPECT_EQ(with.last<mavlink::mission_count>().opaque_id, 0U);
  }
}

} // namespace server_upload_test
} // namespace godwit::ground_port::mission_server::test
