// Each habit in which autopilots differ, as they were seen on the wire.
#include "actors/ground_port/mission_server/server.hpp"
#include "tests/support/time_units.hpp"

#include <gtest/gtest.h>

namespace godwit::ground_port::mission_server {
namespace server_test {

using mavlink::mav_mission_result;
using mavlink::mav_mission_type;
using mavlink::number;
using mavlink::sender;

using godwit::tests::ms;
constexpr sender vehicle_id{1, 1};
constexpr sender station{255, 190};
constexpr sender other_station{254, 190};

// A station that talks to a vehicle without turns, so that each answer comes at once.
class conversation {
public:
  explicit conversation(server_profile vehicle) : server_(without_turns(vehicle), vehicle_id) {}

  template <class M>
  std::vector<outgoing> say(M message, sender from = station, sender to = vehicle_id) {
    message.target_system = to.system;
    message.target_component = to.component;
    const auto out = server_.on(from, message, now_ns_);
    changes_.insert(changes_.end(), out.changes.begin(), out.changes.end());
    return out.messages;
  }
  std::vector<outgoing> wait(std::int64_t duration_ns) { return server_.on_time(now_ns_ += duration_ns).messages; }

  std::vector<outgoing> count(int items, mav_mission_type type = mav_mission_type::mission, sender from = station) {
    mavlink::mission_count message;
    message.count = static_cast<std::uint16_t>(items);
    message.mission_type = number(type);
    return say(message, from);
  }
  static mavlink::mission_item_int item_of(int seq) {
    mavlink::mission_item_int message;
    message.seq = static_cast<std::uint16_t>(seq);
    message.command = number(mavlink::mav_cmd::nav_waypoint);
    message.frame = number(mavlink::mav_frame::global_relative_alt);
    message.x = 500'000'000 + seq;
    return message;
  }
  std::vector<outgoing> item(int seq, sender from = station) { return say(item_of(seq), from); }
  std::vector<outgoing> ack(mav_mission_result result) {
    mavlink::mission_ack message;
    message.type = number(result);
    return say(message);
  }
  template <class Request>
  std::vector<outgoing> request(int seq) {
    Request message;
    message.seq = static_cast<std::uint16_t>(seq);
    return say(message);
  }
  void upload(int items) {
    (void)count(items);
    for (int i = 0; i < items; ++i)
      (void)item(i);
  }

  server& vehicle() { return server_; }
  const std::vector<plan_change>& changes() const { return changes_; }
  std::size_t held(mav_mission_type type = mav_mission_type::mission) { return server_.plan(type).items.size(); }

private:
  static server_profile without_turns(server_profile vehicle) {
    vehicle.turn_ns = 0;
    return vehicle;
  }

  server server_;
  std::int64_t now_ns_ = 1'000 * ms;
  std::vector<plan_change> changes_;
};

std::optional<int> requested(const std::vector<outgoing>& answer) {
  for (const auto& each : answer) {
    if (const auto* request = std::get_if<mavlink::mission_request_int>(&each))
      return request->seq;
    if (const auto* request = std::get_if<mavlink::mission_request>(&each))
      return request->seq;
  }
  return std::nullopt;
}

std::optional<mavlink::mission_ack> acknowledged(const std::vector<outgoing>& answer) {
  for (const auto& each : answer)
    if (const auto* ack = std::get_if<mavlink::mission_ack>(&each))
      return *ack;
  return std::nullopt;
}

std::optional<mav_mission_result> result_of(const std::vector<outgoing>& answer) {
  const auto ack = acknowledged(answer);
  return ack ? std::optional(static_cast<mav_mission_result>(ack->type)) : std::nullopt;
}

TEST(server, asks_for_each_item_and_acknowledges_the_last) {
  conversation with(plain_profile());
  EXPECT_EQ(requested(with.count(3)), 0);
  EXPECT_EQ(requested(with.item(0)), 1);
  EXPECT_EQ(requested(with.item(1)), 2);
  const auto ack = acknowledged(with.item(2));
  ASSERT_TRUE(ack.has_value());
  EXPECT_EQ(ack->type, number(mav_mission_result::accepted));
  EXPECT_EQ(ack->opaque_id, with.vehicle().plan(mav_mission_type::mission).id);
  EXPECT_EQ(ack->target_system, station.system);
  EXPECT_EQ(ack->target_component, station.component);
  EXPECT_EQ(with.held(), 3U);
  ASSERT_EQ(with.changes().size(), 1U);
  EXPECT_EQ(with.changes()[0].count, 3);
  EXPECT_EQ(with.changes()[0].by, station);
}

TEST(server, ardupilot_asks_with_the_deprecated_request_and_px4_with_the_new_one) {
  EXPECT_TRUE(
      std::holds_alternative<mavlink::mission_request>(conversation(ardupilot_copter_profile()).count(3).at(0)));
  EXPECT_TRUE(std::holds_alternative<mavlink::mission_request_int>(conversation(px4_profile()).count(3).at(0)));
}

TEST(server, items_are_taken_ahead_of_their_requests) {
  conversation with(px4_profile());
  (void)with.count(10);
  for (int i = 0; i < 9; ++i)
    EXPECT_EQ(requested(with.item(i)), i + 1);
  EXPECT_EQ(result_of(with.item(9)), mav_mission_result::accepted);
}

TEST(server, asks_again_in_its_own_period_and_gives_up_in_its_own_way) {
  conversation px4(px4_profile());
  (void)px4.count(3);
  EXPECT_TRUE(px4.wait(259 * ms).empty());
  EXPECT_EQ(requested(px4.wait(1 * ms)), 0);
  EXPECT_TRUE(px4.wait(4'740 * ms).empty()) << "silently, after 5 s";
  EXPECT_TRUE(px4.vehicle().is_idle());

  conversation ardupilot(ardupilot_copter_profile());
  (void)ardupilot.count(3);
  EXPECT_EQ(requested(ardupilot.wait(1'000 * ms)), 0);
  EXPECT_EQ(result_of(ardupilot.wait(7'000 * ms)), mav_mission_result::operation_cancelled);
  EXPECT_TRUE(ardupilot.vehicle().is_idle());
}

TEST(server, a_wrong_item_is_ignored_or_an_error_or_asked_for_again) {
  conversation px4(px4_profile());
  (void)px4.count(3);
  EXPECT_TRUE(px4.item(1).empty());
  conversation ardupilot(ardupilot_copter_profile());
  (void)ardupilot.count(3);
  EXPECT_EQ(result_of(ardupilot.item(1)), mav_mission_result::invalid_sequence);
  EXPECT_EQ(requested(ardupilot.item(0)), 1) << "the transfer stays open";
  EXPECT_EQ(result_of(ardupilot.item(0)), mav_mission_result::invalid_sequence) << "a repeated one as well";
  conversation plain(plain_profile());
  (void)plain.count(3);
  EXPECT_EQ(requested(plain.item(2)), 0);
}

TEST(server, the_last_item_again_is_accepted_by_px4_and_an_error_to_ardupilot) {
  conversation px4(px4_profile());
  px4.upload(3);
  const auto again = acknowledged(px4.item(2));
  ASSERT_TRUE(again.has_value());
  EXPECT_EQ(again->type, number(mav_mission_result::accepted));
  EXPECT_EQ(again->opaque_id, px4.vehicle().plan(mav_mission_type::mission).id);
  conversation ardupilot(ardupilot_copter_profile());
  ardupilot.upload(3);
  EXPECT_EQ(result_of(ardupilot.item(2)), mav_mission_result::error);
  EXPECT_EQ(ardupilot.held(), 3U);
}

TEST(server, an_item_without_a_transfer_is_an_error) {
  EXPECT_EQ(result_of(conversation(plain_profile()).item(0)), mav_mission_result::error);
}

TEST(server, a_second_station_is_told_that_the_vehicle_is_busy_and_the_first_goes_on) {
  for (const auto& [vehicle, busy, stray] :
       {std::tuple{px4_profile(), mav_mission_result::error, std::optional<mav_mission_result>()},
        {ardupilot_copter_profile(), mav_mission_result::denied, std::optional(mav_mission_result::invalid_sequence)},
        {plain_profile(), mav_mission_result::denied, std::optional(mav_mission_result::error)}}) {
    conversation with(vehicle);
    (void)with.count(3);
    const auto refused = acknowledged(with.count(5, mav_mission_type::mission, other_station));
    ASSERT_TRUE(refused.has_value());
    EXPECT_EQ(refused->type, number(busy));
    EXPECT_EQ(refused->target_system, other_station.system);
    EXPECT_EQ(requested(with.item(0)), 1);
    EXPECT_EQ(result_of(with.item(0, other_station)), stray) << "it has no transfer";
    EXPECT_EQ(requested(with.item(1)), 2);
  }
}

TEST(server, a_taciturn_one_says_nothing_when_busy) {
  auto vehicle = plain_profile();
  vehicle.when_busy = std::nullopt;
  conversation with(vehicle);
  (void)with.count(3);
  EXPECT_TRUE(with.count(5, mav_mission_type::mission, other_station).empty());
}

TEST(server, a_second_count_of_the_same_station_begins_again_on_ardupilot_and_on_px4_only_at_item_0) {
  conversation ardupilot(ardupilot_copter_profile());
  (void)ardupilot.count(3);
  (void)ardupilot.item(0);
  EXPECT_EQ(requested(ardupilot.count(3)), 0);
  conversation px4(px4_profile());
  (void)px4.count(3);
  EXPECT_EQ(requested(px4.count(3)), 0);
  (void)px4.item(0);
  EXPECT_EQ(result_of(px4.count(3)), mav_mission_result::error);
  EXPECT_EQ(requested(px4.item(1)), 2);
}

TEST(server, cancel_stops_px4_at_once_and_is_ignored_by_ardupilot) {
  conversation px4(px4_profile());
  (void)px4.count(3);
  EXPECT_TRUE(px4.ack(mav_mission_result::operation_cancelled).empty());
  EXPECT_TRUE(px4.vehicle().is_idle());
  conversation ardupilot(ardupilot_copter_profile());
  (void)ardupilot.count(3);
  (void)ardupilot.ack(mav_mission_result::operation_cancelled);
  EXPECT_EQ(requested(ardupilot.wait(1'000 * ms)), 0);
}

TEST(server, count_0_and_clear_all_clear) {
  for (const bool by_count : {true, false}) {
    conversation with(px4_profile());
    with.upload(3);
    const auto answer = by_count ? with.count(0) : with.say(mavlink::mission_clear_all{});
    EXPECT_EQ(result_of(answer), mav_mission_result::accepted);
    EXPECT_EQ(with.held(), 0U);
    EXPECT_EQ(with.changes().back().count, 0);
  }
}

TEST(server, a_plan_that_is_flown_is_not_cleared_and_may_be_replaced) {
  conversation with(plain_profile());
  with.upload(3);
  with.vehicle().lock(true);
  EXPECT_EQ(result_of(with.count(0)), mav_mission_result::denied);
  EXPECT_EQ(result_of(with.say(mavlink::mission_clear_all{})), mav_mission_result::denied);
  EXPECT_EQ(with.held(), 3U);
  with.upload(2);
  EXPECT_EQ(with.held(), 2U);
}

TEST(server, more_items_than_there_is_room_for_are_refused) {
  conversation with(ardupilot_rover_profile());
  EXPECT_EQ(result_of(with.count(656)), mav_mission_result::no_space);
  EXPECT_TRUE(with.vehicle().is_idle());
  EXPECT_EQ(requested(with.count(655)), 0);
}

TEST(server, a_refused_item_ends_the_transfer_and_px4_keeps_the_old_plan) {
  conversation with(px4_profile());
  with.upload(3);
  (void)with.count(2);
  auto bad = conversation::item_of(0);
  bad.command = 9'999;
  EXPECT_EQ(result_of(with.say(bad)), mav_mission_result::unsupported);
  EXPECT_TRUE(with.vehicle().is_idle());
  EXPECT_EQ(with.held(), 3U);
}

TEST(server, latitude_95_is_refused_by_ardupilot_and_taken_by_px4) {
  auto item = conversation::item_of(0);
  item.x = 950'000'000;
  conversation ardupilot(ardupilot_rover_profile());
  (void)ardupilot.count(1);
  EXPECT_EQ(result_of(ardupilot.say(item)), mav_mission_result::invalid_param5_x);
  conversation px4(px4_profile());
  (void)px4.count(1);
  EXPECT_EQ(result_of(px4.say(item)), mav_mission_result::accepted);
}

TEST(server, an_item_of_another_type_is_an_error_and_the_transfer_stays_open) {
  for (const auto& vehicle : {px4_profile(), ardupilot_copter_profile()}) {
    conversation with(vehicle);
    (void)with.count(2);
    auto item = conversation::item_of(0);
    item.mission_type = number(mav_mission_type::fence);
    EXPECT_EQ(result_of(with.say(item)), mav_mission_result::error);
    EXPECT_EQ(requested(with.item(0)), 1);
  }
}

TEST(server, an_unknown_mission_type_is_unsupported_but_px4_clears_it) {
  EXPECT_EQ(result_of(conversation(ardupilot_copter_profile()).count(0, static_cast<mav_mission_type>(7))),
            mav_mission_result::unsupported);
  EXPECT_EQ(result_of(conversation(px4_profile()).count(0, static_cast<mav_mission_type>(7))),
            mav_mission_result::accepted);
}

TEST(server, clearing_all_types_at_once_is_unsupported_by_ardupilot) {
  mavlink::mission_clear_all all;
  all.mission_type = number(mav_mission_type::all);
  conversation ardupilot(ardupilot_copter_profile());
  ardupilot.upload(3);
  EXPECT_EQ(result_of(ardupilot.say(all)), mav_mission_result::unsupported);
  EXPECT_EQ(ardupilot.held(), 3U);
  conversation px4(px4_profile());
  px4.upload(3);
  EXPECT_EQ(result_of(px4.say(all)), mav_mission_result::accepted);
  EXPECT_EQ(px4.held(), 0U);
}

TEST(server, gives_its_plan_in_order_and_the_last_item_twice_if_asked) {
  conversation with(px4_profile());
  with.upload(3);
  const auto count = std::get<mavlink::mission_count>(with.say(mavlink::mission_request_list{}).at(0));
  EXPECT_EQ(count.count, 3);
  EXPECT_EQ(count.opaque_id, with.vehicle().plan(mav_mission_type::mission).id);
  const auto first = std::get<mavlink::mission_item_int>(with.request<mavlink::mission_request_int>(0).at(0));
  EXPECT_EQ(first.seq, 0);
  EXPECT_EQ(first.current, 1) << "PX4 marks the first";
  EXPECT_EQ(with.request<mavlink::mission_request_int>(0).size(), 1U);
  EXPECT_EQ(with.request<mavlink::mission_request_int>(1).size(), 1U);
}

TEST(server, ardupilot_gives_any_item_at_any_time) {
  conversation with(ardupilot_copter_profile());
  with.upload(3);
  EXPECT_EQ(std::get<mavlink::mission_item_int>(with.request<mavlink::mission_request_int>(2).at(0)).seq, 2);
  EXPECT_EQ(result_of(with.request<mavlink::mission_request_int>(999)), mav_mission_result::invalid_sequence);
  conversation px4(px4_profile());
  px4.upload(3);
  EXPECT_TRUE(px4.request<mavlink::mission_request_int>(0).empty()) << "no list was asked for";
}

TEST(server, the_deprecated_request_is_answered_with_the_deprecated_item_or_refused) {
  conversation with(ardupilot_copter_profile());
  with.upload(2);
  EXPECT_TRUE(std::holds_alternative<mavlink::mission_item>(with.request<mavlink::mission_request>(1).at(0)));
  auto modern = plain_profile();
  modern.serves_float_items = false;
  EXPECT_EQ(result_of(conversation(modern).request<mavlink::mission_request>(0)), mav_mission_result::unsupported);
}

TEST(server, px4_is_busy_until_a_download_is_closed_an_empty_one_too) {
  conversation with(px4_profile());
  (void)with.say(mavlink::mission_request_list{});
  EXPECT_EQ(result_of(with.count(3)), mav_mission_result::error);
  (void)with.ack(mav_mission_result::accepted);
  EXPECT_EQ(requested(with.count(3)), 0);

  conversation forgetful(px4_profile());
  (void)forgetful.say(mavlink::mission_request_list{});
  (void)forgetful.wait(5'000 * ms);
  EXPECT_EQ(requested(forgetful.count(3)), 0);

  conversation ardupilot(ardupilot_copter_profile());
  (void)ardupilot.say(mavlink::mission_request_list{});
  EXPECT_EQ(requested(ardupilot.count(3)), 0);
}

TEST(server, a_list_can_be_asked_for_again_when_the_count_was_lost) {
  conversation with(px4_profile());
  with.upload(2);
  (void)with.say(mavlink::mission_request_list{});
  EXPECT_TRUE(std::holds_alternative<mavlink::mission_count>(with.say(mavlink::mission_request_list{}).at(0)));
}

TEST(server, a_float_item_is_taken_and_then_asked_for) {
  conversation with(px4_profile());
  (void)with.count(2);
  mavlink::mission_item item;
  item.command = number(mavlink::mav_cmd::nav_waypoint);
  item.frame = number(mavlink::mav_frame::global_relative_alt);
  item.x = 50;
  const auto answer = with.say(item);
  ASSERT_EQ(answer.size(), 1U);
  EXPECT_TRUE(std::holds_alternative<mavlink::mission_request>(answer[0]));
}

TEST(server, hears_what_is_for_it_and_ardupilot_also_what_is_for_everybody) {
  for (const auto& [vehicle, hears] : {std::pair{px4_profile(), false}, std::pair{ardupilot_copter_profile(), true}}) {
    EXPECT_EQ(!conversation(vehicle).say(mavlink::mission_request_list{}, station, {0, 0}).empty(), hears);
    EXPECT_EQ(!conversation(vehicle).say(mavlink::mission_request_list{}, station, {1, 55}).empty(), hears);
    EXPECT_TRUE(conversation(vehicle).say(mavlink::mission_request_list{}, station, {2, 1}).empty());
  }
}

TEST(server, takes_one_message_in_each_turn) {
  server rover(ardupilot_rover_profile(), vehicle_id);
  mavlink::mission_count count;
  count.target_system = 1;
  count.target_component = 1;
  count.count = 2;
  auto item = conversation::item_of(0);
  item.target_system = 1;
  item.target_component = 1;
  EXPECT_TRUE(rover.on(station, count, 5 * ms).messages.empty());
  EXPECT_TRUE(rover.on(station, item, 6 * ms).messages.empty());
  ASSERT_EQ(rover.next_deadline_ns(), 20 * ms);
  EXPECT_EQ(requested(rover.on_time(20 * ms).messages), std::nullopt) << "item 0 waits already";
  EXPECT_EQ(requested(rover.on_time(40 * ms).messages), 1);
}

TEST(server, a_restart_forgets_the_transfer_and_keeps_the_plan) {
  conversation with(px4_profile());
  with.upload(3);
  (void)with.count(2);
  with.vehicle().restart();
  EXPECT_TRUE(with.vehicle().is_idle());
  EXPECT_EQ(with.held(), 3U);
  EXPECT_EQ(result_of(with.item(0)), mav_mission_result::error);
}

} // namespace server_test
} // namespace godwit::ground_port::mission_server
