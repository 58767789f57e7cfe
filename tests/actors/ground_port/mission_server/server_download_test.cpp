// Downloads in whole exchanges, and in what form a plan comes back: as PX4 1.17 and ArduPilot 4.7 were seen to answer
// on the wire, and as our own server does where they differ.
#include "actors/ground_port/mission_server/server.hpp"

#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "tests/actors/ground_port/mission_server/plan_types.hpp"
#include "tests/actors/ground_port/mission_server/server_fixture.hpp"

namespace godwit::ground_port::mission_server::test {
namespace server_download_test {

using mavlink::mav_cmd;
using mavlink::mav_frame;
using mavlink::mav_mission_result;
using mavlink::number;
using words = dialogue::words;

words ask_for(dialogue& with, int seq, int type = 0, mavlink::sender from = station) {
  return with.tell(request_for<mavlink::mission_request_int>(seq, type), from);
}

// The plan, as a station gets it that asks for one item after the other and closes the download.
std::vector<mavlink::mission_item_int> download(dialogue& with, int type = 0) {
  std::vector<mavlink::mission_item_int> result;
  (void)with.tell(list_of(type));
  const auto count = with.last<mavlink::mission_count>().count;
  for (int seq = 0; seq < count; ++seq) {
    (void)ask_for(with, seq, type);
    result.push_back(with.last<mavlink::mission_item_int>());
  }
  (void)with.tell(ack_of(mav_mission_result::accepted));
  return result;
}

// Everything in it that a vehicle may change.
mavlink::mission_item_int rich_waypoint(int seq) {
  auto item = waypoint(seq);
  item.frame = number(mav_frame::global_relative_alt_int);
  item.current = 1;
  item.autocontinue = 0;
  item.param1 = 5;
  item.param2 = 1;
  item.param3 = 2;
  item.param4 = std::nanf("");
  item.z = 30.25F;
  return item;
}

void upload(dialogue& with, const std::vector<mavlink::mission_item_int>& plan) {
  auto answer = with.tell(count_of(static_cast<int>(plan.size())));
  for (const auto& each : plan)
    answer = with.tell(each);
  ASSERT_EQ(answer, words{"ACK accepted"});
}

void expect_as_sent(const mavlink::mission_item_int& got, const mavlink::mission_item_int& sent) {
  EXPECT_EQ(got.seq, sent.seq);
  EXPECT_EQ(got.frame, sent.frame);
  EXPECT_EQ(got.command, sent.command);
  EXPECT_EQ(got.autocontinue, sent.autocontinue);
  EXPECT_EQ(got.param1, sent.param1);
  EXPECT_EQ(got.param2, sent.param2);
  EXPECT_EQ(got.param3, sent.param3);
  EXPECT_EQ(std::isnan(got.param4), std::isnan(sent.param4));
  EXPECT_EQ(got.x, sent.x);
  EXPECT_EQ(got.y, sent.y);
  EXPECT_EQ(got.z, sent.z);
  EXPECT_EQ(got.mission_type, sent.mission_type);
}

// -- The exchange

TEST(server_download, gives_the_count_and_each_item_and_is_closed_by_an_acknowledgement) {
  for (const auto& vehicle : {px4_profile(), ardupilot_rover_profile(), plain_profile()}) {
    dialogue with(vehicle);
    (void)with.upload(3);
    EXPECT_EQ(with.tell(list_of(0)), words{"COUNT 3"});
    EXPECT_EQ(ask_for(with, 0), words{"ITEM_INT 0"});
    EXPECT_EQ(ask_for(with, 1), words{"ITEM_INT 1"});
    EXPECT_EQ(ask_for(with, 1), words{"ITEM_INT 1"}) << "the item was lost";
    EXPECT_EQ(ask_for(with, 2), words{"ITEM_INT 2"});
    EXPECT_TRUE(with.vehicle().is_giving());
    EXPECT_EQ(with.tell(ack_of(mav_mission_result::accepted)), words());
    EXPECT_TRUE(with.vehicle().is_idle());
    EXPECT_EQ(with.held().items.size(), 3U);
    EXPECT_EQ(resolved(with.changes()).size(), 1U);
  }
}

TEST(server_download, the_three_plans_are_separate) {
  for (const auto& vehicle : {px4_profile(), ardupilot_copter_profile(), plain_profile()}) {
    dialogue with(vehicle);
    (void)with.upload(3);
    (void)with.upload(2, fence);
    EXPECT_EQ(with.tell(list_of(fence)), words{"COUNT 2 type 1"});
    EXPECT_EQ(ask_for(with, 0, fence), words{"ITEM_INT 0 type 1"});
    EXPECT_EQ(with.last<mavlink::mission_item_int>().command, number(mav_cmd::nav_fence_circle_inclusion));
    (void)with.tell(ack_of(mav_mission_result::accepted, fence));
    EXPECT_EQ(with.tell(list_of(rally)), words{"COUNT 0 type 2"});
  }
}

TEST(server_download, there_is_no_plan_of_an_unknown_type) {
  for (const int type : {7, all})
    for (const auto& vehicle : {px4_profile(), ardupilot_copter_profile(), plain_profile()}) {
      dialogue with(vehicle);
      EXPECT_EQ(with.tell(list_of(type)), words{"ACK unsupported type " + std::to_string(type)});
      EXPECT_TRUE(with.vehicle().is_idle());
      EXPECT_EQ(ask_for(with, 0, type), words());
    }
}

TEST(server_download, px4_gives_items_in_order_of_the_open_plan_and_only_to_who_opened_it) {
  dialogue with(px4_profile());
  (void)with.upload(3);
  EXPECT_EQ(ask_for(with, 0), words()) << "nothing is open";
  (void)with.tell(list_of(0));
  EXPECT_EQ(ask_for(with, 0, fence), words());
  EXPECT_EQ(ask_for(with, 0, 0, other_station), words());
  EXPECT_EQ(ask_for(with, 0), words{"ITEM_INT 0"});
  (void)with.tell(ack_of(mav_mission_result::accepted));
  EXPECT_EQ(ask_for(with, 1), words()) << "it is closed";
}

TEST(server_download, a_request_out_of_order_is_not_heard) {
  for (const auto& vehicle : {px4_profile(), plain_profile()}) {
    dialogue with(vehicle);
    (void)with.upload(3);
    (void)with.tell(list_of(0));
    for (const int seq : {1, 2, 999})
      EXPECT_EQ(ask_for(with, seq), words());
    EXPECT_EQ(ask_for(with, 0), words{"ITEM_INT 0"});
  }
}

TEST(server_download, our_own_server_gives_again_what_it_gave_before_and_px4_only_the_last) {
  for (const auto& vehicle : {px4_profile(), plain_profile()}) {
    dialogue with(vehicle);
    (void)with.upload(5);
    (void)with.tell(list_of(0));
    for (const int seq : {0, 1, 2, 3})
      (void)ask_for(with, seq);
    EXPECT_EQ(ask_for(with, 1), vehicle.serves_earlier_items ? words{"ITEM_INT 1"} : words());
    EXPECT_EQ(ask_for(with, 4), words{"ITEM_INT 4"}) << "it goes on where it was";
  }
}

TEST(server_download, an_acknowledgement_of_another_type_does_not_close_it) {
  for (const auto& vehicle : {px4_profile(), plain_profile()}) {
    dialogue with(vehicle);
    (void)with.upload(2);
    (void)with.tell(list_of(0));
    (void)with.tell(ack_of(mav_mission_result::accepted, fence));
    EXPECT_EQ(ask_for(with, 0), words{"ITEM_INT 0"});
  }
}

TEST(server_download, px4_takes_a_list_request_for_the_end_of_a_download_of_which_each_item_is_given) {
  dialogue with(px4_profile());
  (void)with.upload(2);
  (void)with.tell(list_of(0));
  (void)ask_for(with, 0);
  EXPECT_EQ(with.tell(list_of(0), other_station), words());
  (void)ask_for(with, 1);
  EXPECT_EQ(with.tell(list_of(0), other_station), words{"254/190 COUNT 2"});
}

TEST(server_download, ardupilot_gives_any_item_to_anybody_and_says_which_does_not_exist) {
  dialogue with(ardupilot_copter_profile());
  (void)with.upload(3);
  EXPECT_EQ(ask_for(with, 2), words{"ITEM_INT 2"});
  EXPECT_EQ(ask_for(with, 0, 0, other_station), words{"254/190 ITEM_INT 0"});
  EXPECT_EQ(ask_for(with, 3), (words{"COUNT 3", "ACK invalid_sequence"})) << "and how many there are";
  EXPECT_EQ(ask_for(with, 999), (words{"COUNT 3", "ACK invalid_sequence"}));
  EXPECT_EQ(ask_for(with, 0, rally), (words{"COUNT 0 type 2", "ACK invalid_sequence type 2"}));
}

TEST(server_download, ardupilot_takes_a_turn_for_each_item) {
  dialogue with(ardupilot_rover_profile());
  (void)with.upload(100);
  with.send(list_of(0));
  for (int seq = 0; seq < 90; ++seq)
    with.send(request_for<mavlink::mission_request_int>(seq));
  const auto first_turn_ns = with.vehicle().next_deadline_ns();
  EXPECT_EQ(with.wait(first_turn_ns + 1'800 * ms - 1 - with.now_ns()).size(), 90U);
  EXPECT_EQ(with.wait(1), words{"ITEM_INT 89"});
}

// -- Busy

TEST(server_download, px4_is_busy_for_everybody_until_it_is_closed) {
  dialogue with(px4_profile());
  (void)with.upload(2);
  (void)with.tell(list_of(0));
  EXPECT_EQ(with.tell(count_of(3)), words{"ACK error"}) << "for the station itself as well";
  EXPECT_EQ(with.tell(count_of(3), other_station), words{"254/190 ACK error"});
  EXPECT_EQ(with.texts(), words(2, "WPM: IGN MISSION_COUNT: Busy\t"));
  EXPECT_EQ(with.tell(clear_of(0)), words{"ACK error"});
  EXPECT_EQ(with.texts(), words{"WPM: IGN CLEAR CMD: Busy\t"});
  EXPECT_EQ(with.tell(list_of(0), other_station), words());
  EXPECT_EQ(with.texts(), words{"Mission download request ignored, already active\t"});
  EXPECT_EQ(with.tell(ack_of(mav_mission_result::accepted), other_station), words());
  EXPECT_TRUE(with.vehicle().is_giving()) << "another station can not close it";
  EXPECT_EQ(ask_for(with, 0), words{"ITEM_INT 0"});
  (void)with.tell(ack_of(mav_mission_result::accepted));
  EXPECT_EQ(with.tell(list_of(0), other_station), words{"254/190 COUNT 2"});
}

TEST(server_download, px4_closes_it_5_s_after_the_last_request_an_empty_one_too) {
  dialogue with(px4_profile());
  EXPECT_EQ(with.tell(list_of(0)), words{"COUNT 0"});
  (void)with.wait(5 * s - 1);
  EXPECT_EQ(with.tell(count_of(1), other_station), words{"254/190 ACK error"});
  (void)with.wait(1);
  EXPECT_EQ(with.upload(1, 0, other_station), words{"254/190 ACK accepted"});

  (void)with.tell(list_of(0));
  (void)with.wait(4 * s);
  (void)ask_for(with, 0);
  EXPECT_EQ(with.wait(5 * s - 1), words());
  EXPECT_TRUE(with.vehicle().is_giving());
  EXPECT_EQ(with.wait(1), words());
  EXPECT_TRUE(with.vehicle().is_idle());
}

TEST(server_download, ardupilot_takes_a_plan_from_another_station_while_one_is_read) {
  dialogue with(ardupilot_copter_profile());
  (void)with.upload(2);
  (void)with.tell(list_of(0));
  EXPECT_EQ(with.upload(3, 0, other_station), words{"254/190 ACK accepted"});
}

TEST(server_download, while_a_plan_comes_in_none_is_given) {
  for (const auto& vehicle : {plain_profile(), ardupilot_copter_profile()}) {
    dialogue with(vehicle);
    (void)with.tell(count_of(2));
    EXPECT_EQ(with.tell(list_of(0)), words{"ACK denied"});
    EXPECT_EQ(with.tell(list_of(0), other_station), words{"254/190 ACK denied"});
    EXPECT_TRUE(with.vehicle().is_receiving());
  }
  dialogue px4(px4_profile());
  (void)px4.tell(count_of(2));
  EXPECT_EQ(px4.tell(list_of(0)), words());
  EXPECT_EQ(px4.tell(list_of(0), other_station), words());
  EXPECT_TRUE(px4.vehicle().is_receiving());
  dialogue ardupilot(ardupilot_copter_profile());
  (void)ardupilot.upload(2);
  (void)ardupilot.tell(count_of(2));
  EXPECT_EQ(ask_for(ardupilot, 1, 0, other_station), words{"254/190 ACK denied"}) << "nor an item of the old one";
}

TEST(server_download, our_server_goes_on_with_the_first_station_and_refuses_the_others) {
  dialogue with(plain_profile());
  (void)with.upload(2);
  (void)with.tell(list_of(0));
  (void)ask_for(with, 0);
  EXPECT_EQ(with.tell(list_of(0), other_station), words{"254/190 ACK denied"});
  EXPECT_EQ(with.tell(count_of(3), other_station), words{"254/190 ACK denied"});
  EXPECT_EQ(with.tell(count_of(0), other_station), words{"254/190 ACK denied"});
  EXPECT_EQ(with.tell(clear_of(all), other_station), words{"254/190 ACK denied type 255"});
  EXPECT_EQ(with.vehicle().partner(), station);
  EXPECT_EQ(ask_for(with, 1), words{"ITEM_INT 1"});
  (void)with.tell(ack_of(mav_mission_result::accepted));
  EXPECT_EQ(with.held().items.size(), 2U);
  EXPECT_EQ(with.tell(list_of(0), other_station), words{"254/190 COUNT 2"});
  EXPECT_EQ(with.tell(count_of(3), other_station), words{"254/190 REQUEST_INT 0"}) << "the reader itself may go on";
}

// -- Addresses

TEST(server_download, ardupilot_hears_what_is_for_everybody_and_px4_what_is_for_itself_or_each_component) {
  for (const mavlink::sender to : {mavlink::sender{0, 0}, mavlink::sender{1, 0}, mavlink::sender{1, 55}}) {
    const auto px4_answer = to == mavlink::sender{1, 0} ? words{"COUNT 0"} : words();
    EXPECT_EQ(dialogue(ardupilot_rover_profile()).tell(list_of(0), station, to), words{"COUNT 0"});
    EXPECT_EQ(dialogue(px4_profile()).tell(list_of(0), station, to), px4_answer);
    EXPECT_EQ(dialogue(plain_profile()).tell(list_of(0), station, to), words());
  }
  for (const auto& vehicle : {px4_profile(), ardupilot_rover_profile(), plain_profile()})
    EXPECT_EQ(dialogue(vehicle).tell(list_of(0), station, {2, 1}), words());
}

// -- Form

TEST(server_download, px4_and_our_server_give_back_what_was_sent) {
  for (const auto& vehicle : {px4_profile(), plain_profile()}) {
    dialogue with(vehicle);
    const std::vector plan{rich_waypoint(0), rich_waypoint(1), rich_waypoint(2)};
    upload(with, plan);
    const auto got = download(with);
    ASSERT_EQ(got.size(), plan.size());
    for (std::size_t i = 0; i < plan.size(); ++i)
      expect_as_sent(got[i], plan[i]);
  }
}

TEST(server_download, px4_marks_the_item_at_which_it_is_and_that_is_item_0_of_a_new_mission) {
  dialogue with(px4_profile());
  upload(with, {rich_waypoint(0), rich_waypoint(1)});
  auto got = download(with);
  ASSERT_EQ(got.size(), 2U);
  EXPECT_EQ(got[0].current, 1);
  EXPECT_EQ(got[1].current, 0) << "sent with 1";
  with.vehicle().set_current(1);
  got = download(with);
  EXPECT_EQ(got.at(0).current, 0);
  EXPECT_EQ(got.at(1).current, 1);
  (void)with.upload(1, fence);
  got = download(with, fence);
  ASSERT_EQ(got.size(), 1U);
  EXPECT_EQ(got[0].current, 0);
}

TEST(server_download, item_0_of_an_ardupilot_mission_is_home_and_counts) {
  auto vehicle = ardupilot_copter_profile();
  vehicle.home->x = 123;
  vehicle.home->y = 456;
  dialogue with(vehicle);
  (void)with.upload(5);
  const auto got = download(with);
  ASSERT_EQ(got.size(), 5U);
  EXPECT_EQ(got[0].x, 123);
  EXPECT_EQ(got[0].y, 456);
  EXPECT_EQ(got[0].frame, number(mav_frame::global));
  EXPECT_EQ(got[1].x, waypoint(1).x);
  (void)with.upload(2, rally);
  EXPECT_EQ(download(with, rally).at(0).x, waypoint(0).x) << "a rally point is no home";
}

TEST(server_download, ardupilot_gives_the_meaning_back_and_not_the_bytes) {
  dialogue with(ardupilot_copter_profile());
  auto home_again = rich_waypoint(2);
  home_again.command = number(mav_cmd::nav_return_to_launch);
  auto flat = rich_waypoint(3);
  flat.param4 = 0;
  upload(with, {rich_waypoint(0), rich_waypoint(1), home_again, flat});
  const auto got = download(with);
  ASSERT_EQ(got.size(), 4U);
  EXPECT_EQ(got[1].frame, number(mav_frame::global_relative_alt)) << "6 was sent";
  EXPECT_EQ(got[1].param2, 0.0F);
  EXPECT_EQ(got[1].autocontinue, 1);
  EXPECT_EQ(got[1].command, number(mav_cmd::nav_waypoint));
  EXPECT_EQ(got[1].param1, 5.0F);
  EXPECT_EQ(got[1].x, waypoint(1).x);
  EXPECT_EQ(got[1].y, waypoint(1).y);
  EXPECT_EQ(got[1].z, 30.25F);
  EXPECT_EQ(got[2].frame, number(mav_frame::global));
  EXPECT_EQ(got[3].param4, 0.0F);
}

TEST(server_download, the_deprecated_request_is_answered_in_degrees) {
  for (const auto& vehicle : {px4_profile(), ardupilot_copter_profile()}) {
    dialogue with(vehicle);
    (void)with.upload(2);
    (void)with.tell(list_of(0));
    (void)ask_for(with, 0);
    EXPECT_EQ(with.tell(request_for<mavlink::mission_request>(1)), words{"ITEM 1"});
    EXPECT_FLOAT_EQ(with.last<mavlink::mission_item>().x, 50.0F);
    EXPECT_FLOAT_EQ(with.last<mavlink::mission_item>().y, 36.4F);
  }
}

TEST(server_download, a_vehicle_without_floats_refuses_the_deprecated_request_and_stays_open) {
  auto vehicle = plain_profile();
  vehicle.serves_float_items = false;
  dialogue with(vehicle);
  (void)with.upload(2);
  (void)with.tell(list_of(0));
  EXPECT_EQ(with.tell(request_for<mavlink::mission_request>(0)), words{"ACK unsupported"});
  EXPECT_EQ(ask_for(with, 0), words{"ITEM_INT 0"});
}

} // namespace server_download_test
} // namespace godwit::ground_port::mission_server::test
