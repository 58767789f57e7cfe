// Commands, parameters and clocks on the ground port.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/actors/ground_port/port_fixture.hpp"
#include "tests/actors/ground_port/results.hpp"

namespace godwit::ground_port {
namespace core_commands_test {

using namespace test;
using mavlink::mav_cmd;
using mavlink::mav_result;

mavlink::command_long request(std::uint32_t id) { return command(mav_cmd::request_message, static_cast<float>(id)); }

template <class M>
mavlink::command_long interval(float us) {
  return command(mav_cmd::set_message_interval, static_cast<float>(M::message_id), us);
}

TEST(ground_port_commands, an_unknown_command_is_unsupported) {
  port_fixture port;
  port.say(mavlink::command_long{.command = 31'000});
  EXPECT_EQ(port.last_result(), unsupported);
  port.say(mavlink::command_int{.command = 31'001});
  EXPECT_EQ(port.last<mavlink::command_ack>().command, 31'001);
  EXPECT_EQ(port.last_result(), unsupported);
}

TEST(ground_port_commands, versions_are_given_by_each_of_the_ways_to_ask) {
  port_fixture port;
  for (const auto& ask : {request(148), command(static_cast<mav_cmd>(520), 1)}) {
    port.forget();
    port.say(ask);
    EXPECT_EQ(port.last_result(), accepted);
    EXPECT_EQ(port.last<mavlink::autopilot_version>().capabilities & 4U, 4U);
  }
  for (const auto& ask : {request(300), command(static_cast<mav_cmd>(519), 1)}) {
    port.forget();
    port.say(ask);
    EXPECT_EQ(port.last_result(), accepted);
    EXPECT_EQ(port.last<mavlink::protocol_version>().max_version, 200);
  }
}

TEST(ground_port_commands, the_answer_comes_before_the_message) {
  port_fixture port;
  port.forget();
  port.say(request(300));
  ASSERT_EQ(port.frames.size(), 2U);
  EXPECT_EQ(port.frames[0].frame.view().id(), mavlink::command_ack::message_id);
}

TEST(ground_port_commands, the_vehicles_versions_are_shown_with_the_capabilities_of_the_port) {
  port_fixture port;
  port.vehicle_says(mavlink::autopilot_version{.capabilities = ~std::uint64_t{0}, .flight_sw_version = 77});
  port.say(request(148));
  EXPECT_EQ(port.last<mavlink::autopilot_version>().flight_sw_version, 77U);
  EXPECT_NE(port.last<mavlink::autopilot_version>().capabilities, ~std::uint64_t{0});
}

TEST(ground_port_commands, what_is_forwarded_can_be_asked_for_once_it_was_heard) {
  port_fixture port;
  port.say(request(242));
  EXPECT_EQ(port.last_result(), failed);
  port.vehicle_says(mavlink::home_position{.latitude = 7});
  port.forget();
  port.say(request(242));
  EXPECT_EQ(port.last_result(), accepted);
  EXPECT_EQ(port.last<mavlink::home_position>().latitude, 7);
  port.forget();
  port.say(command(static_cast<mav_cmd>(410)));
  EXPECT_EQ(port.last<mavlink::home_position>().latitude, 7);
}

TEST(ground_port_commands, mission_current_can_be_asked_for) {
  port_fixture port;
  port.upload(3);
  port.advance(300 * ms);
  port.forget();
  port.say(request(42));
  EXPECT_EQ(port.last<mavlink::mission_current>().total, 3);
}

TEST(ground_port_commands, a_message_that_the_port_does_not_send_is_denied) {
  port_fixture port;
  for (const float id : {9'999.0F, 77.0F, -1.0F, 0.5F, NAN, 1e20F}) {
    port.say(command(mav_cmd::request_message, id));
    EXPECT_EQ(port.last_result(), denied) << id;
  }
}

TEST(ground_port_commands, a_station_sets_how_often_a_message_goes_on) {
  port_fixture port;
  port.say(interval<mavlink::attitude>(1'000'000));
  EXPECT_EQ(port.last_result(), accepted);
  port.forget();
  for (int i = 0; i < 100; ++i) {
    port.vehicle_says(mavlink::attitude{});
    port.advance(100 * ms);
  }
  EXPECT_NEAR(static_cast<double>(port.sent<mavlink::attitude>().size()), 10, 2);
  port.say(interval<mavlink::attitude>(-1));
  port.forget();
  port.vehicle_says(mavlink::attitude{});
  EXPECT_TRUE(port.sent<mavlink::attitude>().empty());
  port.say(interval<mavlink::attitude>(0));
  port.advance(1 * s);
  port.vehicle_says(mavlink::attitude{});
  EXPECT_EQ(port.sent<mavlink::attitude>().size(), 1U);
}

TEST(ground_port_commands, intervals_of_what_is_not_forwarded_and_intervals_that_are_none_are_denied) {
  port_fixture port;
  for (const auto& bad :
       {interval<mavlink::heartbeat>(-1), interval<mavlink::param_value>(1'000), interval<mavlink::attitude>(-2),
        interval<mavlink::attitude>(NAN), interval<mavlink::attitude>(1e20F), interval<mavlink::attitude>(2.5F)}) {
    port.say(bad);
    EXPECT_EQ(port.last_result(), denied);
  }
}

TEST(ground_port_commands, mission_current_comes_at_least_once_a_second) {
  port_fixture port;
  port.say(interval<mavlink::mission_current>(5'000'000));
  EXPECT_EQ(port.last_result(), denied);
  port.say(interval<mavlink::mission_current>(-1));
  EXPECT_EQ(port.last_result(), denied);
  port.say(interval<mavlink::mission_current>(200'000));
  EXPECT_EQ(port.last_result(), accepted);
  port.forget();
  port.advance(2 * s);
  EXPECT_EQ(port.sent<mavlink::mission_current>().size(), 10U);
}

// -- whom it is for -------------------------------------------------------------------------------

TEST(ground_port_commands, a_command_to_the_autopilot_is_not_passed_on_and_said_so_once_a_minute) {
  port_fixture port;
  port.forget();
  for (int i = 0; i < 100; ++i) {
    port.say(mavlink::command_long{.target_system = 1, .target_component = 1, .command = 400, .param1 = 1});
    port.say(mavlink::command_int{.target_system = 1, .target_component = 1, .command = 192});
    port.advance(500 * ms);
  }
  EXPECT_TRUE(port.sent<mavlink::command_ack>().empty());
  EXPECT_EQ(port.texts(), std::vector<std::string>{"This port passes no commands to the autopilot"});
  EXPECT_EQ(port.count_of("commands_for_autopilot"), 200U);
  EXPECT_TRUE(port.starts.empty());
  port.say(mavlink::command_long{.target_system = 1, .target_component = 1, .command = 400}, other_station);
  EXPECT_EQ(port.texts().size(), 2U) << "each station is told";
}

TEST(ground_port_commands, nothing_of_a_station_goes_on_to_the_vehicle) {
  port_fixture port;
  port.forget();
  port.say(mavlink::set_mode{.target_system = 1, .base_mode = 1, .custom_mode = 4});
  port.say(mavlink::mission_count{.target_system = 1, .target_component = 1, .count = 5});
  port.say(mavlink::param_set{.target_system = 1, .target_component = 1});
  port.advance(100 * ms);
  for (const auto& each : port.frames)
    EXPECT_EQ(each.frame.view().from(), port_id);
  EXPECT_TRUE(port.sent<mavlink::mission_request_int>().empty());
}

TEST(ground_port_commands, component_0_and_system_0_mean_us_too) {
  port_fixture port;
  port.upload(3);
  port.say_as_it_is(mavlink::command_long{.target_system = 1, .command = 512, .param1 = 300});
  EXPECT_EQ(port.last_result(), accepted);
  port.forget();
  port.say_as_it_is(mavlink::command_long{.command = 512, .param1 = 300});
  EXPECT_EQ(port.last_result(), accepted);
}

TEST(ground_port_commands, a_broadcast_that_we_do_not_know_is_not_answered) {
  port_fixture port;
  port.say_as_it_is(mavlink::command_long{.command = 2'003});
  EXPECT_EQ(port.last_result(), -1);
  port.say_as_it_is(mavlink::command_long{.target_system = 1, .command = 2'003});
  EXPECT_EQ(port.last_result(), unsupported) << "our system alone is meant";
}

TEST(ground_port_commands, other_systems_and_components_are_not_us) {
  port_fixture port;
  port.say(mavlink::command_long{.target_system = 2, .target_component = 191, .command = 512, .param1 = 300});
  port.say(mavlink::command_long{.target_system = 1, .target_component = 55, .command = 512, .param1 = 300});
  EXPECT_EQ(port.last_result(), -1);
  EXPECT_EQ(port.count_of("not_for_us"), 2U);
}

TEST(ground_port_commands, only_stations_are_answered) {
  port_fixture port;
  port.upload(3);
  port.forget();
  // An autopilot sends commands to all components of its system during a mission.
  port.say_as_it_is(mavlink::command_long{.target_system = 1, .command = 300}, autopilot_id);
  port.say_as_it_is(mavlink::command_long{.target_system = 1, .command = 300}, {1, 100});
  EXPECT_EQ(port.last_result(), -1);
  EXPECT_TRUE(port.starts.empty());
  EXPECT_EQ(port.count_of("from_own_system"), 2U);
}

// -- while a station connects ---------------------------------------------------------------------

TEST(ground_port_commands, parameters_are_listed_and_read_and_stay_as_they_are) {
  port_fixture port;
  port.say(mavlink::param_request_list{});
  port.advance(100 * ms);
  const auto listed = port.sent<mavlink::param_value>();
  ASSERT_FALSE(listed.empty());
  EXPECT_EQ(listed.size(), listed[0].param_count);
  port.say(mavlink::param_request_read{.param_index = 1});
  EXPECT_EQ(port.last<mavlink::param_value>().param_id, listed[1].param_id);
  port.say(mavlink::param_set{.param_id = listed[0].param_id, .param_value = 99, .param_type = 9});
  EXPECT_EQ(port.last<mavlink::param_value>().param_value, listed[0].param_value);
}

TEST(ground_port_commands, clocks_are_compared) {
  port_fixture port;
  port.say_as_it_is(mavlink::timesync{.ts1 = 1'234});
  EXPECT_EQ(port.last<mavlink::timesync>().ts1, 1'234);
  EXPECT_EQ(port.last<mavlink::timesync>().tc1, port.now().monotonic_ns);
  port.forget();
  port.say_as_it_is(mavlink::timesync{.tc1 = 5, .ts1 = 1'234});
  EXPECT_TRUE(port.sent<mavlink::timesync>().empty()) << "an answer, not a question";
}

TEST(ground_port_commands, a_ping_is_answered_to_the_one_who_asked) {
  port_fixture port;
  port.say_as_it_is(mavlink::ping{.time_usec = 5, .seq = 9});
  EXPECT_EQ(port.last<mavlink::ping>().seq, 9U);
  EXPECT_EQ(port.last<mavlink::ping>().target_system, station_id.system);
  port.forget();
  port.say_as_it_is(mavlink::ping{.seq = 9, .target_system = 1, .target_component = 191});
  EXPECT_TRUE(port.sent<mavlink::ping>().empty());
}

} // namespace core_commands_test
} // namespace godwit::ground_port
