// The link, the stations, forwarding, standing in for the autopilot, signing.
#include <gtest/gtest.h>

#include <set>

#include "tests/actors/ground_port/port_fixture.hpp"

namespace godwit::ground_port {
namespace core_test {

using namespace test;

settings in_the_autopilots_place() {
  settings result;
  result.as.component = 1;
  return result;
}

mavlink::heartbeat station_beat() { return {.type = mavlink::number(mavlink::mav_type::gcs)}; }
mavlink::heartbeat vehicle_beat() { return {.type = 2, .autopilot = 12, .base_mode = 128}; }

// -- who we are -----------------------------------------------------------------------------------

TEST(ground_port, its_own_heartbeat_goes_out_once_a_second) {
  port_fixture port;
  port.advance(500 * ms);
  port.forget();
  port.advance(10 * s);
  const auto beats = port.sent<mavlink::heartbeat>();
  EXPECT_EQ(beats.size(), 10U);
  EXPECT_EQ(beats[0].type, mavlink::number(mavlink::mav_type::onboard_controller));
  EXPECT_EQ(beats[0].autopilot, mavlink::number(mavlink::mav_autopilot::invalid));
  EXPECT_EQ(port.frames[0].frame.view().from(), port_id);
}

TEST(ground_port, what_the_vehicle_says_goes_on_as_the_vehicles) {
  port_fixture port;
  port.forget();
  port.vehicle_says(vehicle_beat());
  port.vehicle_says(mavlink::global_position_int{.lat = 5});
  ASSERT_EQ(port.frames.size(), 2U);
  for (const auto& each : port.frames)
    EXPECT_EQ(each.frame.view().from(), autopilot_id);
  EXPECT_EQ(port.last<mavlink::global_position_int>().lat, 5);
}

TEST(ground_port, each_sender_has_sequence_numbers_of_its_own) {
  port_fixture port;
  port.forget();
  for (int i = 0; i < 10; ++i) {
    port.vehicle_says(vehicle_beat());
    port.advance(1 * s);
  }
  for (const auto who : {port_id, autopilot_id}) {
    std::optional<std::uint8_t> last;
    for (const auto& each : port.frames)
      if (each.frame.view().from() == who) {
        EXPECT_TRUE(!last || each.frame.view().sequence() == static_cast<std::uint8_t>(*last + 1));
        last = each.frame.view().sequence();
      }
    EXPECT_TRUE(last);
  }
}

TEST(ground_port, a_fast_stream_of_the_vehicle_is_held_back_and_counted) {
  port_fixture port;
  port.forget();
  for (int i = 0; i < 500; ++i) { // 50 Hz, as PX4 sends it
    port.vehicle_says(mavlink::attitude{});
    port.vehicle_says(mavlink::global_position_int{});
    port.advance(20 * ms);
  }
  EXPECT_NEAR(static_cast<double>(port.sent<mavlink::attitude>().size()), 40, 5);
  EXPECT_NEAR(static_cast<double>(port.sent<mavlink::global_position_int>().size()), 40, 5);
  EXPECT_GT(port.count_of("held_back"), 900U);
}

TEST(ground_port, texts_of_the_vehicle_go_on) {
  port_fixture port;
  mavlink::statustext text;
  text.text = {'E', 'K', 'F', ' ', 'o', 'k'};
  port.vehicle_says(text);
  EXPECT_TRUE(port.said("EKF ok"));
}

TEST(ground_port, forwarding_can_be_switched_off) {
  settings quiet;
  quiet.forwards_telemetry = false;
  port_fixture port(quiet);
  port.forget();
  port.vehicle_says(vehicle_beat());
  EXPECT_TRUE(port.frames.empty());
}

// Over UDP it is they that find out that a station that was not there yet listens now.
TEST(ground_port, only_heartbeats_and_mission_current_are_sent_while_the_link_is_down) {
  port_fixture port;
  port.link_is(io::link::link_phase::down);
  port.forget();
  port.vehicle_says(vehicle_beat());
  port.executor_says(status_text{mavlink::mav_severity::info, "x"});
  port.advance(3 * s);
  EXPECT_GE(port.sent<mavlink::heartbeat>().size(), 3U);
  EXPECT_EQ(port.frames.size(), port.sent<mavlink::heartbeat>().size() + port.sent<mavlink::mission_current>().size());
  EXPECT_GT(port.count_of("not_sent"), 0U);
  EXPECT_EQ(port.port().health(port.now()).how, godwit::runtime::health_colour::yellow);
  port.link_is(io::link::link_phase::up);
  port.advance(1 * s);
  EXPECT_FALSE(port.frames.empty());
}

// -- in the autopilot's place ---------------------------------------------------------------------

TEST(ground_port_as_autopilot, the_vehicles_heartbeat_is_the_only_one) {
  port_fixture port(in_the_autopilots_place());
  port.forget();
  port.advance(5 * s);
  EXPECT_TRUE(port.sent<mavlink::heartbeat>().empty()) << "a vehicle that is silent must not seem alive";
  port.vehicle_says(vehicle_beat());
  EXPECT_EQ(port.last<mavlink::heartbeat>().autopilot, 12);
  for (const auto& each : port.frames)
    EXPECT_EQ(each.frame.view().from(), autopilot_id);
}

TEST(ground_port_as_autopilot, the_progress_shown_is_ours_and_not_the_vehicles) {
  port_fixture port(in_the_autopilots_place());
  port.upload(3);
  port.advance(1 * s);
  port.forget();
  port.vehicle_says(mavlink::mission_current{.seq = 77, .total = 99});
  port.vehicle_says(mavlink::mission_item_reached{.seq = 77});
  port.advance(3 * s);
  EXPECT_TRUE(port.sent<mavlink::mission_item_reached>().empty());
  for (const auto& each : port.sent<mavlink::mission_current>())
    EXPECT_EQ(each.total, 3);
}

TEST(ground_port_as_autopilot, beside_the_autopilot_its_progress_goes_on) {
  port_fixture port;
  port.forget();
  port.vehicle_says(mavlink::mission_item_reached{.seq = 77});
  EXPECT_EQ(port.last<mavlink::mission_item_reached>().seq, 77);
}

TEST(ground_port_core, a_radio_that_reports_its_status_says_nothing_of_who_is_there) {
  port_fixture port;
  port.say_as_it_is(mavlink::radio_status{}, {255, 190}, 7);
  port.say_as_it_is(mavlink::radio_status{}, autopilot_id, 7);
  EXPECT_TRUE(port.shown().stations.empty());
  EXPECT_FALSE(port.shown().autopilot_heard);
  EXPECT_EQ(port.count_of("not_accepted"), 2U);
}

TEST(ground_port_as_autopilot, it_stands_down_when_the_autopilot_itself_is_on_the_port) {
  port_fixture port(in_the_autopilots_place());
  const auto id = port.upload(3).opaque_id;
  port.say_as_it_is(vehicle_beat(), autopilot_id);
  port.forget();
  port.advance(2 * s);
  ASSERT_FALSE(port.frames.empty());
  for (const auto& each : port.frames)
    EXPECT_EQ(each.frame.view().from(), port_id);
  EXPECT_EQ(port.last<mavlink::mission_current>().mission_id, id) << "the plans stay";
  EXPECT_EQ(port.port().health(port.now()).how, godwit::runtime::health_colour::red);
  EXPECT_TRUE(port.shown().autopilot_heard);
  port.forget();
  port.say(mavlink::command_long{.target_system = 1, .target_component = 1, .command = 300});
  EXPECT_TRUE(port.sent<mavlink::command_ack>().empty()) << "the autopilot answers for itself";
}

TEST(ground_port_as_autopilot, three_forged_heartbeats_of_the_autopilot_do_not_make_it_stand_down) {
  auto settings = in_the_autopilots_place();
  settings.heartbeats_to_begin = 4;
  port_fixture port(settings);
  for (int i = 0; i < 3; ++i) {
    port.say_as_it_is(vehicle_beat(), autopilot_id, 9);
    port.say_as_it_is(mavlink::attitude{}, autopilot_id, 9);
    port.advance(1 * s);
  }
  EXPECT_FALSE(port.shown().autopilot_heard);
  EXPECT_EQ(port.shown().component, 1U);
  EXPECT_EQ(port.port().health(port.now()).how, godwit::runtime::health_colour::green);
}

TEST(ground_port_as_autopilot, it_stands_in_again_when_the_autopilot_has_been_silent_for_a_minute) {
  port_fixture port(in_the_autopilots_place());
  const auto id = port.upload(3).opaque_id;
  port.say_as_it_is(vehicle_beat(), autopilot_id);
  port.advance(59 * s);
  EXPECT_EQ(port.shown().component, 191U);
  port.advance(2 * s);
  EXPECT_EQ(port.shown().component, 1U);
  EXPECT_EQ(port.last<mavlink::mission_current>().mission_id, id) << "the plans stay";
  EXPECT_EQ(port.port().health(port.now()).how, godwit::runtime::health_colour::green);
}

TEST(ground_port, a_sender_without_a_name_is_not_heard) {
  port_fixture port;
  for (const auto who : {mavlink::sender{0, 0}, mavlink::sender{255, 0}, mavlink::sender{0, 190}})
    port.say(start_command(), who);
  EXPECT_TRUE(port.sent<mavlink::command_ack>().empty());
  EXPECT_TRUE(port.shown().stations.empty());
}

TEST(ground_port_as_autopilot, it_says_why_it_stood_down) {
  port_fixture port(in_the_autopilots_place());
  port.say_as_it_is(vehicle_beat(), autopilot_id);
  port.advance(1 * s);
  EXPECT_FALSE(port.texts().empty());
}

TEST(ground_port, an_autopilot_that_is_on_the_port_itself_is_not_forwarded_as_well) {
  port_fixture port;
  port.say_as_it_is(vehicle_beat(), autopilot_id);
  port.forget();
  port.vehicle_says(mavlink::attitude{});
  EXPECT_TRUE(port.sent<mavlink::attitude>().empty());
  port.advance(autopilot_is_here_ns);
  port.vehicle_says(mavlink::attitude{});
  EXPECT_EQ(port.sent<mavlink::attitude>().size(), 1U) << "it is gone";
  EXPECT_EQ(port.port().health(port.now()).how, godwit::runtime::health_colour::green);
}

// -- stations -------------------------------------------------------------------------------------

TEST(ground_port, the_operators_link_is_the_age_of_the_last_heartbeat_of_a_ground_station) {
  port_fixture port;
  port.advance(1 * s);
  EXPECT_FALSE(port.operator_news.back().ever_heard);
  EXPECT_EQ(port.operator_news.back().age_ms, -1);
  port.say(mavlink::heartbeat{.type = 18}, {250, 1});
  port.advance(1 * s);
  EXPECT_FALSE(port.operator_news.back().ever_heard) << "that is no ground station";
  port.say(station_beat());
  port.say(station_beat(), other_station);
  port.advance(1 * s);
  EXPECT_TRUE(port.operator_news.back().ever_heard);
  EXPECT_LE(port.operator_news.back().age_ms, 1'000);
  EXPECT_EQ(port.operator_news.back().stations, 2U);
  port.advance(30 * s);
  EXPECT_NEAR(static_cast<double>(port.operator_news.back().age_ms), 31'000, 1'000);
  EXPECT_EQ(port.operator_news.back().stations, 0U);
}

TEST(ground_port, the_operators_link_is_told_once_a_second) {
  port_fixture port;
  port.advance(500 * ms);
  const auto before = port.operator_news.size();
  port.advance(10 * s);
  EXPECT_EQ(port.operator_news.size() - before, 10U);
}

TEST(ground_port, more_stations_than_the_bound_are_refused_until_one_is_silent) {
  port_fixture port;
  for (std::uint8_t i = 0; i < 20; ++i)
    port.say(mavlink::mission_request_list{}, {static_cast<std::uint8_t>(200 + i), 190});
  EXPECT_EQ(port.shown().stations.size(), station_table::max_stations);
  EXPECT_EQ(port.count_of("stations_refused"), 4U);
  port.advance(6 * s);
  port.forget();
  port.say(mavlink::ping{}, {250, 190});
  port.say_as_it_is(mavlink::ping{}, {250, 190});
  EXPECT_EQ(port.last<mavlink::ping>().target_system, 250);
  EXPECT_EQ(port.count_of("stations_evicted"), 1U);
}

TEST(ground_port, messages_that_are_not_on_the_list_are_counted_and_go_no_further) {
  port_fixture port;
  port.forget();
  port.say(mavlink::attitude{});
  port.say(mavlink::setup_signing{.target_system = 1, .target_component = 191});
  port.say(mavlink::mission_current{});
  EXPECT_EQ(port.count_of("not_accepted"), 3U);
  EXPECT_TRUE(port.frames.empty());
}

TEST(ground_port, a_flood_of_texts_of_the_executor_is_bounded) {
  port_fixture port;
  port.forget();
  for (int i = 0; i < 1'000; ++i)
    port.executor_says(status_text{mavlink::mav_severity::info, "text"});
  port.advance(60 * s);
  EXPECT_LE(port.texts().size(), text_queue::max_waiting_frames + text_queue::at_once);
  EXPECT_GT(port.count_of("texts_dropped"), 900U);
}

// -- signing --------------------------------------------------------------------------------------

signing_settings signed_port() {
  std::array<std::byte, mavlink::secret_key_size> bytes{};
  bytes.fill(std::byte{7});
  return {.key = std::make_shared<mavlink::secret_key>(bytes), .link = mavlink::link_id{2}, .unsigned_frames = {}};
}

TEST(ground_port, on_a_signed_port_unsigned_frames_are_not_heard_and_its_own_are_signed) {
  port_fixture port({}, true, signed_port());
  port.forget();
  port.say(mavlink::mission_request_list{});
  EXPECT_TRUE(port.sent<mavlink::mission_count>().empty());
  EXPECT_TRUE(port.shown().stations.empty());
  EXPECT_EQ(port.port().health(port.now()).how, godwit::runtime::health_colour::yellow);
  port.vehicle_says(vehicle_beat());
  port.advance(1 * s);
  for (const auto& each : port.frames)
    EXPECT_TRUE(each.frame.view().is_signed());
  EXPECT_EQ(port.count_of("signing_rejected"), 1U);
}

TEST(ground_port, a_station_with_the_key_is_heard) {
  port_fixture port({}, true, signed_port());
  mavlink::channel theirs(signed_port(), mavlink::signing_time{});
  const auto frame = theirs.pack(mavlink::mission_request_list{.target_system = 1, .target_component = 191}, station_id,
                                 port.now().wall_ns);
  port.forget();
  port.bytes(io::link::only_peer, frame->span());
  EXPECT_EQ(port.sent<mavlink::mission_count>().size(), 1U);
}

} // namespace core_test
} // namespace godwit::ground_port
