// Mode commands of ground stations at the port: what the base mode says besides the custom flag makes no difference.
// MAVSDK and QGroundControl copy the armed flag from the vehicle's heartbeat into it.
#include <array>

#include <gtest/gtest.h>

#include "tests/actors/ground_port/port_fixture.hpp"

namespace godwit::ground_port {
namespace station_modes_test {

using namespace test;
using executor::act_kind;
using executor::act_verdict;
using mavlink::mav_autopilot;
using mavlink::mav_cmd;
using mavlink::mav_result;
using mavlink::mav_type;
using mavlink::mission_state;

constexpr std::uint32_t px4_mode(std::uint32_t main, std::uint32_t sub = 0) { return main << 16U | sub << 24U; }

struct vehicle {
  mav_autopilot autopilot;
  mav_type type;
  std::vector<std::uint32_t> modes;
  std::uint32_t mission;
  std::uint32_t hold;
};

// All that they have, and some that nobody has.
std::vector<vehicle> all_vehicles() {
  const auto up_to = [](std::uint32_t last) {
    std::vector<std::uint32_t> result;
    for (std::uint32_t i = 0; i <= last; ++i)
      result.push_back(i);
    return result;
  };
  std::vector<std::uint32_t> px4;
  for (const std::uint32_t main : {1U, 2U, 3U, 5U, 6U, 7U, 8U, 9U})
    px4.push_back(px4_mode(main));
  for (std::uint32_t sub = 1; sub <= 11; ++sub)
    px4.push_back(px4_mode(4, sub));
  px4.push_back(px4_mode(3, 1));
  px4.push_back(px4_mode(3, 2));
  return {{mav_autopilot::px4, mav_type::quadrotor, px4, px4_mode(4, 4), px4_mode(4, 3)},
          {mav_autopilot::ardupilotmega, mav_type::quadrotor, up_to(29), 3, 17},
          {mav_autopilot::ardupilotmega, mav_type::fixed_wing, up_to(26), 10, 12},
          {mav_autopilot::ardupilotmega, mav_type::ground_rover, up_to(17), 10, 4}};
}

settings passing_settings() {
  settings result;
  result.as.component = 1;
  result.passes = true;
  return result;
}

// As the port sees it.
enum class flight_phase { ground, armed, flying, paused };
constexpr std::array all_phases{flight_phase::ground, flight_phase::armed, flight_phase::flying, flight_phase::paused};

enum class form { command, message };

class station_mode {
public:
  station_mode(const vehicle& what, flight_phase where) : vehicle_(what) {
    mavlink::heartbeat beat;
    beat.type = mavlink::number(what.type);
    beat.autopilot = mavlink::number(what.autopilot);
    beat.base_mode = where == flight_phase::ground ? 0x01 : 0x81;
    beat.custom_mode = where == flight_phase::flying ? what.mission : what.hold;
    port.vehicle_says(beat);
    port.upload(3);
    if (where == flight_phase::flying || where == flight_phase::paused)
      port.executor_says(
          mission_progress{port.shown().plans[0].plan_id, 1,
                           where == flight_phase::flying ? mission_state::active : mission_state::paused});
    port.forget();
  }

  void say(form how, std::uint32_t mode, std::uint8_t base_mode) {
    if (how == form::message)
      return port.say(mavlink::set_mode{.target_system = 1, .base_mode = base_mode, .custom_mode = mode});
    auto m = command(mav_cmd::do_set_mode, base_mode);
    m.param2 = static_cast<float>(vehicle_.autopilot == mav_autopilot::px4 ? mode >> 16U & 0xFFU : mode);
    m.param3 = static_cast<float>(vehicle_.autopilot == mav_autopilot::px4 ? mode >> 24U : 0);
    port.say(m);
  }

  // What the port has done with it, but for the frame itself.
  [[nodiscard]] std::string done() const {
    std::string result;
    for (const auto& each : port.acts)
      result += "asked " + std::string(io::name_of(each.what.kind)) + ' ' + each.what.what + '\n';
    for (const auto& each : port.starts)
      result += "started from " + std::to_string(each.first) + (each.by_mode ? " by mode\n" : "\n");
    for (const auto& each : port.words)
      result += "said " + std::string(io::name_of(each.what.kind)) + '\n';
    for (const auto& each : port.sent<mavlink::command_ack>())
      result += "answered " + std::to_string(each.result) + '\n';
    return result + "passed on " + std::to_string(port.passed_on.size());
  }

  port_fixture port{passing_settings()};

private:
  vehicle vehicle_;
};

std::string deed(const vehicle& what, flight_phase where, form how, std::uint32_t mode, std::uint8_t base_mode) {
  station_mode one(what, where);
  one.say(how, mode, base_mode);
  return one.done();
}

TEST(station_modes, the_armed_flag_and_all_other_flags_of_a_mode_command_are_ignored) {
  for (const auto& vehicle : all_vehicles())
    for (const auto mode : vehicle.modes)
      for (const auto where : all_phases)
        for (const auto how : {form::command, form::message}) {
          const auto plain = deed(vehicle, where, how, mode, 1);
          const bool is_there = mode == vehicle.mission && where == flight_phase::flying;
          ASSERT_TRUE(plain != "passed on 0" || (is_there && how == form::message)) << mode << ": nothing comes of it";
          for (int base_mode = 3; base_mode <= 255; base_mode += 2)
            ASSERT_EQ(deed(vehicle, where, how, mode, static_cast<std::uint8_t>(base_mode)), plain)
                << "mode " << mode << ", base mode " << base_mode;
        }
}

TEST(station_modes, a_base_mode_without_the_custom_flag_is_denied_and_nothing_comes_of_it) {
  for (const auto& vehicle : all_vehicles())
    for (const auto where : all_phases)
      for (int base_mode = 0; base_mode <= 254; base_mode += 2) {
        station_mode one(vehicle, where);
        one.say(form::command, vehicle.hold, static_cast<std::uint8_t>(base_mode));
        ASSERT_EQ(one.done(), "answered 2\npassed on 0") << "base mode " << base_mode;
        station_mode other(vehicle, where);
        other.say(form::message, vehicle.hold, static_cast<std::uint8_t>(base_mode));
        const bool answers = vehicle.autopilot == mav_autopilot::px4;
        ASSERT_EQ(other.done(), answers ? "answered 2\npassed on 0" : "passed on 0") << "base mode " << base_mode;
      }
}

// QGroundControl says so to a PX4, which answers it as DO_SET_MODE; an ArduPilot does not.
TEST(station_modes, a_mode_by_message_is_answered_as_the_vehicle_would_answer_it) {
  for (const auto& vehicle : all_vehicles()) {
    station_mode one(vehicle, flight_phase::paused);
    one.say(form::message, vehicle.mission, 157);
    ASSERT_EQ(one.port.acts.size(), 1U);
    EXPECT_EQ(one.port.acts[0].what.kind, act_kind::go_on);
    one.port.executor_says(act_verdict::done);
    const auto answers = one.port.sent<mavlink::command_ack>();
    ASSERT_EQ(answers.size(), vehicle.autopilot == mav_autopilot::px4 ? 1U : 0U);
    if (!answers.empty()) {
      EXPECT_EQ(answers[0].command, mavlink::number(mav_cmd::do_set_mode));
      EXPECT_EQ(answers[0].result, mavlink::number(mav_result::accepted));
    }
  }
}

// Found with MAVSDK 3.17 (129, 209) and QGroundControl (157) on a PX4: accepted, and the vehicle flew on.
TEST(station_modes, as_MAVSDK_and_QGroundControl_send_it_a_mode_goes_on_when_the_executor_has_let_it) {
  for (const auto& vehicle : all_vehicles())
    for (const std::uint8_t base_mode : {129, 157, 209})
      for (const auto mode : vehicle.modes) {
        if (mode == vehicle.mission)
          continue;
        station_mode one(vehicle, flight_phase::flying);
        one.say(form::command, mode, base_mode);
        ASSERT_EQ(one.port.acts.size(), 1U);
        ASSERT_NE(one.port.acts[0].what.kind, act_kind::arm);
        one.port.executor_says(act_verdict::pass);
        EXPECT_EQ(one.port.passed_on.size(), 1U) << mode;
        EXPECT_EQ(one.port.last_result(), -1) << "the vehicle answers";
      }
}

TEST(station_modes, a_mode_that_ends_the_motion_goes_on_with_the_armed_flag_also_where_the_executor_is_silent) {
  for (const auto& vehicle : all_vehicles()) {
    station_mode one(vehicle, flight_phase::flying);
    one.say(form::command, vehicle.hold, 209);
    one.port.executor_is_silent();
    EXPECT_EQ(one.port.passed_on.size(), 1U);
  }
}

// The mode that was heard last is older than what has gone on to the vehicle.
TEST(station_modes, the_mission_mode_after_another_one_is_not_answered_by_the_mode_of_before) {
  for (const auto& vehicle : all_vehicles()) {
    station_mode one(vehicle, flight_phase::flying);
    one.say(form::command, vehicle.modes.front(), 209);
    one.port.executor_says(act_verdict::pass);
    one.say(form::command, vehicle.mission, 209);
    EXPECT_EQ(one.port.last_result(), -1);
    EXPECT_EQ(one.port.starts.size(), 1U) << "the executor knows who has the vehicle";
  }
}

TEST(station_modes, the_mission_mode_with_the_armed_flag_resumes_a_paused_flight) {
  for (const auto& vehicle : all_vehicles()) {
    station_mode one(vehicle, flight_phase::paused);
    one.say(form::command, vehicle.mission, 209);
    ASSERT_EQ(one.port.acts.size(), 1U);
    EXPECT_EQ(one.port.acts[0].what.kind, act_kind::go_on);
    one.port.executor_says(act_verdict::begun);
    EXPECT_EQ(one.port.last_result(), -1);
    one.port.executor_resolves(act_verdict::done);
    EXPECT_EQ(one.port.last_result(), mavlink::number(mav_result::accepted));
  }
}

} // namespace station_modes_test
} // namespace godwit::ground_port
