// Mission items that an ArduPilot flies to at once, as QGroundControl sends them for its first "go to".
#include <gtest/gtest.h>

#include "actors/ground_port/passing/as_said.hpp"
#include "tests/actors/ground_port/port_fixture.hpp"

namespace godwit::ground_port {
namespace core_items_test {

using namespace test;
using executor::act_kind;
using executor::act_verdict;
using mavlink::mav_mission_result;

settings passing_settings() {
  settings result;
  result.as.component = 1;
  result.passes = true;
  return result;
}

mavlink::mission_item to_fly_to(std::uint8_t current = 2) {
  return {.target_system = 1,
          .target_component = 1,
          .frame = mavlink::number(mavlink::mav_frame::global_relative_alt),
          .command = mavlink::number(mavlink::mav_cmd::nav_waypoint),
          .current = current,
          .autocontinue = 1,
          .x = 47.40005F,
          .y = 8.555517F,
          .z = 20};
}

class ground_port_items : public testing::Test {
protected:
  ground_port_items() { is_of(mavlink::mav_autopilot::ardupilotmega); }
  void is_of(mavlink::mav_autopilot autopilot) {
    port.vehicle_says(mavlink::heartbeat{.type = mavlink::number(mavlink::mav_type::quadrotor),
                                         .autopilot = mavlink::number(autopilot),
                                         .base_mode = 129,
                                         .custom_mode = 4});
    port.forget();
  }
  void vehicle_acknowledges(mavlink::sender to) {
    port.component_says(passing::as_said(
        mavlink::mission_ack{.target_system = to.system, .target_component = to.component}, autopilot_id));
  }

  port_fixture port{passing_settings()};
};

TEST_F(ground_port_items, one_that_is_flown_to_at_once_is_a_go_to_of_godwit_while_that_has_the_vehicle) {
  port.say(to_fly_to());
  ASSERT_EQ(port.acts.size(), 1U);
  EXPECT_EQ(port.acts[0].what.kind, act_kind::go_to);
  EXPECT_FALSE(port.acts[0].what.is_acknowledged) << "by a COMMAND_ACK";
  port.executor_says(act_verdict::own);
  ASSERT_EQ(port.words.size(), 1U);
  EXPECT_EQ(port.words[0].what.kind, operators::command_kind::go_to);
  EXPECT_NEAR(port.words[0].what.place->latitude, 47.40005, 1e-5); // it came as a float
  EXPECT_EQ(port.words[0].what.place->altitude_m, 20);
  EXPECT_TRUE(port.passed_on.empty());
  port.executor_says(operators::answer{true, {}});
  ASSERT_EQ(port.sent<mavlink::mission_ack>().size(), 1U);
  EXPECT_EQ(port.last<mavlink::mission_ack>().type, mavlink::number(mav_mission_result::accepted));
  EXPECT_EQ(port.last_result(), -1) << "no command was said";
}

TEST_F(ground_port_items, it_goes_on_while_a_person_has_the_vehicle_and_its_answer_comes_back_once) {
  port.say(to_fly_to());
  port.executor_says(act_verdict::pass);
  ASSERT_EQ(port.passed_on.size(), 1U);
  EXPECT_EQ(port.passed_on[0].message, mavlink::mission_item::message_id);
  vehicle_acknowledges(other_station);
  EXPECT_TRUE(port.sent<mavlink::mission_ack>().empty()) << "godwit's own transfers are nobody's";
  vehicle_acknowledges(station_id);
  vehicle_acknowledges(station_id);
  EXPECT_EQ(port.sent<mavlink::mission_ack>().size(), 1U);
}

TEST_F(ground_port_items, one_that_is_refused_is_answered_with_an_error) {
  port.say(to_fly_to());
  port.executor_says(act_verdict::refused, "not now");
  EXPECT_EQ(port.last<mavlink::mission_ack>().type, mavlink::number(mav_mission_result::error));
}

TEST_F(ground_port_items, the_altitude_alone_is_a_persons_command) {
  port.say(to_fly_to(3));
  ASSERT_EQ(port.acts.size(), 1U);
  EXPECT_EQ(port.acts[0].what.kind, act_kind::command);
}

TEST_F(ground_port_items, the_items_of_an_upload_are_none_and_a_px4_has_none) {
  port.upload(3);
  EXPECT_TRUE(port.acts.empty());
  is_of(mavlink::mav_autopilot::px4);
  port.say(to_fly_to());
  EXPECT_TRUE(port.acts.empty());
}

} // namespace core_items_test
} // namespace godwit::ground_port
