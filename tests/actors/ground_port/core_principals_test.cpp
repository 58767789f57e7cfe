// Stations beside operators: whose start, plan and words count, and what is written down of it.
#include <gtest/gtest.h>

#include <limits>

#include "tests/actors/ground_port/port_fixture.hpp"

namespace godwit::ground_port {
namespace core_principals_test {

using namespace test;
using mavlink::mav_cmd;
using mavlink::mav_mission_result;
using mavlink::mav_result;
using operators::command_kind;
using operators::role;

constexpr int accepted = static_cast<int>(mav_result::accepted);
constexpr int temporarily_rejected = static_cast<int>(mav_result::temporarily_rejected);
constexpr int denied = static_cast<int>(mav_result::denied);

settings beside_operators(role what = role::operator_) {
  settings result;
  result.stations_are = what;
  return result;
}

mavlink::command_int go_to_command() {
  return {.frame = mavlink::number(mavlink::mav_frame::global_relative_alt),
          .command = mavlink::number(mav_cmd::do_reposition),
          .param1 = -1,
          .param4 = std::numeric_limits<float>::quiet_NaN(),
          .x = 500'000'000,
          .y = 364'000'000,
          .z = 30};
}

struct shared_port : port_fixture {
  explicit shared_port(role what = role::operator_) : port_fixture(beside_operators(what)) {
    has_control("");
    (void)upload(3);
    forget();
    rows.clear();
  }
  // All that moves the vehicle by godwit, and a plan.
  void expect_refused(int result, const std::string& why, const std::string& outcome) {
    const auto expect = [&](const std::string& what) {
      EXPECT_EQ(last_result(), result) << what;
      ASSERT_EQ(rows.size(), 1U) << what;
      EXPECT_EQ(rows[0].what, what);
      EXPECT_EQ(rows[0].outcome, outcome) << what;
      rows.clear();
      advance(2 * s);
      EXPECT_TRUE(said(what + ": " + why)) << what;
      forget();
    };
    say(start_command());
    expect("Mission start");
    say(go_to_command());
    expect("Go to");
    say(command(mav_cmd::do_pause_continue, 1));
    expect("Continue");
    say(command(mav_cmd::do_set_mission_current, 1));
    expect("Set current");
    EXPECT_EQ(upload(2).type, mavlink::number(mav_mission_result::denied));
    ASSERT_EQ(rows.size(), 1U);
    EXPECT_EQ(rows[0].what, "Upload");
    say(mavlink::mission_clear_all{});
    EXPECT_EQ(last<mavlink::mission_ack>().type, mavlink::number(mav_mission_result::denied));
    EXPECT_EQ(download().size(), 3U) << "the plan is as it was";
    EXPECT_TRUE(starts.empty());
    EXPECT_TRUE(words.empty());
    EXPECT_TRUE(set_currents.empty());
  }
};

TEST(ground_port_principals, while_somebody_else_has_control_what_stations_want_of_godwit_is_rejected_with_the_name) {
  shared_port port;
  port.has_control("anna");
  port.expect_refused(temporarily_rejected, "anna has control", "no_control");
}

TEST(ground_port_principals, of_stations_that_only_look_it_is_denied) {
  settings viewers = beside_operators(role::viewer);
  port_fixture port(viewers);
  port.has_control("");
  port.say(go_to_command());
  EXPECT_EQ(port.last_result(), denied);
  EXPECT_EQ(port.rows.at(0).outcome, "wrong_role");
  EXPECT_EQ(port.upload(2).type, mavlink::number(mav_mission_result::denied));
}

TEST(ground_port_principals, before_it_is_known_who_has_control_it_is_rejected) {
  port_fixture port(beside_operators());
  port.say(go_to_command());
  EXPECT_EQ(port.last_result(), temporarily_rejected);
  EXPECT_TRUE(port.words.empty());
}

TEST(ground_port_principals, a_hold_is_asked_of_the_executor_whoever_has_control_and_also_when_nobody_knows_who) {
  for (const auto what : {role::operator_, role::viewer}) {
    port_fixture port(beside_operators(what));
    for (const auto* holder : {"", "anna"}) {
      port.say(command(mav_cmd::do_pause_continue, 0));
      ASSERT_FALSE(port.words.empty());
      EXPECT_EQ(port.words.back().what.kind, command_kind::pause);
      port.executor_says(operators::answer{true, {}});
      EXPECT_EQ(port.last_result(), accepted);
      port.has_control(holder);
      port.advance(5 * s);
    }
    EXPECT_EQ(port.words.size(), 2U);
  }
}

TEST(ground_port_principals, when_control_is_free_again_stations_are_heard_and_each_outcome_is_one_row) {
  shared_port port;
  port.has_control("anna");
  port.has_control("");
  port.say(go_to_command());
  port.executor_says(operators::answer{false, "a fence is in the way"});
  ASSERT_EQ(port.rows.size(), 1U);
  EXPECT_EQ(port.rows[0].what, "Go to");
  EXPECT_EQ(port.rows[0].outcome, "refused");
  EXPECT_EQ(port.rows[0].reason, "a fence is in the way");
  EXPECT_EQ(port.rows[0].who, station_id);
  port.rows.clear();
  EXPECT_EQ(port.upload(2).type, 0);
  ASSERT_EQ(port.rows.size(), 1U);
  EXPECT_EQ(port.rows[0].what, "Upload");
  EXPECT_EQ(port.rows[0].outcome, "taken");
  port.rows.clear();
  port.say(start_command());
  port.executor_answers(executor::start_verdict::started);
  ASSERT_EQ(port.rows.size(), 1U);
  EXPECT_EQ(port.rows[0].what, "Mission start");
  EXPECT_EQ(port.rows[0].outcome, "taken");
}

// -- what people do by hand --------------------------------------------------------------------------

struct passing_port : port_fixture {
  passing_port() : port_fixture(configured()) {
    mavlink::heartbeat copter{.type = 2, .autopilot = 3, .base_mode = 1};
    vehicle_says(copter);
    has_control("anna");
  }
  static settings configured() {
    auto result = beside_operators();
    result.as.component = 1;
    result.passes = true;
    return result;
  }
  void expect_row(const std::string& what, const std::string& outcome) {
    ASSERT_EQ(rows.size(), 1U) << what;
    EXPECT_EQ(rows[0].what, what);
    EXPECT_EQ(rows[0].outcome, outcome) << what;
    EXPECT_EQ(rows[0].who, station_id) << what;
    rows.clear();
  }
};

TEST(ground_port_principals, what_a_person_does_by_hand_is_one_row_each_whoever_has_control) {
  passing_port port;
  port.say(command(mav_cmd::component_arm_disarm, 1));
  port.executor_says(executor::act_verdict::pass);
  port.expect_row("Arm", "taken");
  port.say(command(mav_cmd::component_arm_disarm, 0));
  port.executor_says(executor::act_verdict::pass);
  port.expect_row("Disarm", "taken");
  port.say(command(mav_cmd::nav_takeoff));
  port.executor_says(executor::act_verdict::done);
  port.expect_row("Take off", "taken");
  port.say(command(mav_cmd::nav_land));
  port.executor_says(executor::act_verdict::refused, "not now");
  port.expect_row("Land", "refused");
  port.say(command(mav_cmd::do_set_mode, 1, 6));
  port.executor_says(executor::act_verdict::pass);
  port.expect_row("Mode returning (6)", "taken");
}

TEST(ground_port_principals, what_goes_on_without_the_executors_word_is_a_row_too) {
  passing_port port;
  port.say(command(mav_cmd::nav_land));
  port.executor_is_silent();
  port.expect_row("Land", "taken");
  port.say(command(mav_cmd::component_arm_disarm, 1));
  port.executor_is_silent();
  port.expect_row("Arm", "refused");
}

TEST(ground_port_principals, sticks_and_parameters_are_one_row_when_they_begin) {
  passing_port port;
  const auto stick = [&](std::int16_t x) {
    std::vector<std::uint8_t> payload(11, 1);
    payload[0] = static_cast<std::uint8_t>(x);
    const mavlink::frame_buffer frame(69, mavlink::find_message(69)->crc_extra, std::as_bytes(std::span(payload)),
                                      station_id, 0, false);
    port.bytes(io::link::only_peer, frame.span());
    port.executor_says(executor::act_verdict::pass);
  };
  for (std::int16_t i = 0; i < 50; ++i) {
    stick(i);
    port.advance(s / 10);
  }
  port.expect_row("MANUAL_CONTROL", "taken");
  port.advance(6 * s); // let go of
  stick(1);
  port.expect_row("MANUAL_CONTROL", "taken");
}

TEST(ground_port_principals, without_operators_beside_them_nothing_is_asked_and_nothing_written) {
  port_fixture port;
  port.say(go_to_command());
  port.executor_says(operators::answer{true, {}});
  EXPECT_EQ(port.last_result(), accepted);
  EXPECT_TRUE(port.rows.empty());
}

} // namespace core_principals_test
} // namespace godwit::ground_port
