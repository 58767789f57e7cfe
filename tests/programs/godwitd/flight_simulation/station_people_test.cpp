// People who act through a ground station, on the real composition of the daemon: what they do comes to the vehicle,
// and from then on the vehicle is theirs.
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "actors/domain/flight_mode/flight_modes.hpp"
#include "io/mavlink/frame.hpp"
#include "programs/godwit-drill/flight_simulation/flight_judge.hpp"
#include "programs/godwit-drill/flight_simulation/flight_people.hpp"
#include "programs/godwit-drill/flight_simulation/vehicle_modes.hpp"

namespace station_people_test {

using namespace godwit;
using namespace godwit::drill;
using executor::pause_cause;
using executor::phase;
using io::mavlink::mav_cmd;

// MANUAL_CONTROL to system 1: all axes in the middle, no button.
std::vector<std::byte> neutral_sticks() {
  constexpr std::uint8_t crc_extra = 243;
  constexpr std::array<std::uint8_t, 11> payload{0, 0, 0, 0, 0xF4, 1, 0, 0, 0, 0, 1};
  const io::mavlink::frame_buffer frame(69, crc_extra, std::as_bytes(std::span(payload)), simulated_station::self, 0,
                                        false);
  return {frame.span().begin(), frame.span().end()};
}

class station_people : public testing::TestWithParam<sim::personality> {
protected:
  flight_simulation flight{
      {.who = GetParam(), .starts_by_itself = false, .arms_on_start = false, .speaks_as_autopilot = true}};

  // As the autopilot numbers it; PX4 has it in two parameters.
  void set_mode(flight::mode_kind kind) {
    const auto command = godwit::flight::mode_command(owner(), kind);
    ASSERT_TRUE(command);
    flight.station().command(mav_cmd::do_set_mode, command->param1, command->param2, command->param3);
  }
  [[nodiscard]] static godwit::flight::mode_owner owner() { return drill::owner_of(GetParam()); }
  testing::AssertionResult arm() {
    if (!flight.run_until_phase(phase::ready, 120))
      return testing::AssertionFailure() << flight.story();
    // An ArduPilot arms in no mission mode; what it stands in here is its first.
    if (GetParam() == sim::personality::ardupilot || GetParam() == sim::personality::plane)
      set_mode(godwit::flight::mode_kind::guided);
    flight.run_for(1);
    flight.station().command(mav_cmd::component_arm_disarm, 1);
    const bool is_armed = flight.run_until([&] { return flight.vehicle().describe().armed; }, 5);
    return is_armed ? testing::AssertionSuccess() : testing::AssertionFailure() << flight.story();
  }
  testing::AssertionResult start() {
    if (const auto armed = arm(); !armed)
      return armed;
    flight.run_for(0.3); // in a world that is ten times as fast: an ArduPilot disarms by itself after ten seconds
    flight.station().start_mission();
    return flight.run_until_phase(phase::flying, 30) ? testing::AssertionSuccess()
                                                     : testing::AssertionFailure() << flight.story();
  }
};

// QGroundControl takes what begins with "preflight" for a failed check, and shows a banner.
TEST_P(station_people, each_text_of_the_vehicle_comes_from_it_alone_and_no_check_that_passes_is_called_failed) {
  ASSERT_TRUE(start());
  EXPECT_FALSE(flight.station().was_told("the vehicle says")) << flight.story();
  EXPECT_TRUE(flight.station().was_told("The preflight checks pass.")) << flight.story();
  EXPECT_FALSE(flight.station().was_told("preflight: The preflight checks pass.")) << flight.story();
}

TEST_P(station_people, parameters_are_read_through_godwit) {
  ASSERT_TRUE(flight.run_until_phase(phase::ready, 120)) << flight.story();
  flight.station().ask_for_params();
  EXPECT_TRUE(flight.run_until([&] { return flight.station().params_heard() > 5; }, 30)) << flight.story();
}

TEST_P(station_people, arming_through_a_station_makes_the_vehicle_its_persons_before_it_is_armed) {
  ASSERT_TRUE(arm());
  EXPECT_EQ(flight.status().cause, pause_cause::taken_over) << flight.story();
  EXPECT_EQ(flight.station().result_of(mav_cmd::component_arm_disarm), 0) << "the vehicle's own answer";
  flight.run_for(0.1); // its arming is after it
  const auto since_ns = flight.now_ns();
  flight.say(operators::command_kind::start);
  flight.run_for(5);
  EXPECT_EQ(moves_since(flight, since_ns), 0) << flight.story();
}

TEST_P(station_people, arm_and_start_of_one_station_fly_because_its_start_hands_back) {
  ASSERT_TRUE(start());
  ASSERT_TRUE(flight.station().start_answer());
  EXPECT_EQ(flight.station().start_answer()->result, 0) << flight.story();
  EXPECT_TRUE(flight.run_until_phase(phase::done, 300)) << flight.story();
  EXPECT_EQ(flaw_of_reports(flight), "") << flight.story();
}

// As QGroundControl starts a PX4: it waits for the mission mode, and arms then.
TEST_P(station_people, the_mission_mode_and_then_the_arm_of_one_station_fly) {
  ASSERT_TRUE(flight.run_until_phase(phase::ready, 120)) << flight.story();
  set_mode(godwit::flight::mode_kind::mission);
  ASSERT_TRUE(flight.run_until([&] { return flight.station().result_of(mav_cmd::do_set_mode).has_value(); }, 10))
      << flight.story();
  EXPECT_EQ(flight.station().result_of(mav_cmd::do_set_mode), 0) << flight.story();
  flight.run_for(1);
  EXPECT_FALSE(flight.vehicle().describe().armed) << "the mode alone moves nothing";
  flight.station().command(mav_cmd::component_arm_disarm, 1);
  EXPECT_TRUE(flight.run_until_phase(phase::flying, 30)) << flight.story();
  EXPECT_EQ(flight.station().result_of(mav_cmd::component_arm_disarm), 0) << flight.story();
  EXPECT_TRUE(flight.run_until_phase(phase::done, 300)) << flight.story();
  EXPECT_EQ(flaw_of_reports(flight), "") << flight.story();
}

TEST_P(station_people, a_return_by_a_station_is_the_autopilots_at_once_and_nothing_is_sent_after_it) {
  ASSERT_TRUE(start());
  flight.run_for(5);
  set_mode(godwit::flight::mode_kind::returning);
  ASSERT_TRUE(flight.run_until_phase(phase::paused, 1)) << flight.story();
  EXPECT_EQ(flight.status().cause, pause_cause::taken_over) << flight.story();
  flight.run_for(0.5); // what the station has said reaches the vehicle
  const auto since_ns = flight.now_ns();
  flight.run_for(20);
  EXPECT_EQ(moves_since(flight, since_ns), 0) << flight.story();
}

TEST_P(station_people, the_hold_mode_of_a_station_is_godwits_pause_and_its_mission_mode_goes_on) {
  ASSERT_TRUE(start());
  flight.run_for(5);
  set_mode(godwit::flight::mode_kind::hold);
  ASSERT_TRUE(flight.run_until_phase(phase::paused, 10)) << flight.story();
  EXPECT_EQ(flight.status().cause, pause_cause::asked) << flight.story();
  EXPECT_EQ(flight.station().result_of(mav_cmd::do_set_mode), 0) << flight.story();
  flight.run_for(3);
  set_mode(godwit::flight::mode_kind::mission);
  EXPECT_TRUE(flight.run_until_phase(phase::flying, 10)) << flight.story();
  EXPECT_TRUE(flight.run_until_phase(phase::done, 300)) << flight.story();
}

TEST_P(station_people, FR_00089_an_item_that_a_station_chooses_in_flight_is_flown_next) {
  ASSERT_TRUE(start());
  const auto has_reached_one = [&] {
    const auto reports = flight.reports();
    return std::ranges::any_of(reports, [](const auto& each) { return each.item_id == "w1"; });
  };
  ASSERT_TRUE(flight.run_until(has_reached_one, 120)) << flight.story();
  flight.station().command(mav_cmd::do_set_mission_current, 1);
  ASSERT_TRUE(
      flight.run_until([&] { return flight.station().result_of(mav_cmd::do_set_mission_current).has_value(); }, 15))
      << flight.story();
  EXPECT_EQ(flight.station().result_of(mav_cmd::do_set_mission_current), 0) << flight.story();
  EXPECT_TRUE(flight.run_until_phase(phase::done, 300)) << flight.story();
}

INSTANTIATE_TEST_SUITE_P(every_vehicle, station_people,
                         testing::Values(sim::personality::rover, sim::personality::px4, sim::personality::ardupilot,
                                         sim::personality::plane),
                         [](const auto& who) { return std::string(io::name_of(who.param)); });

// A virtual joystick that nobody touches, at 10 Hz: a PX4 that has heard it and misses it returns.
class idle_sticks : public testing::TestWithParam<sim::personality> {};

TEST_P(idle_sticks, keep_no_mission_from_its_end) {
  flight_simulation flight({.who = GetParam(), .speaks_as_autopilot = true});
  std::int64_t next_ns = 0;
  const auto is_done = [&] {
    if (flight.now_ns() >= next_ns) {
      flight.station().send_frame(neutral_sticks());
      next_ns = flight.now_ns() + 100'000'000;
    }
    return flight.status().now == phase::done;
  };
  EXPECT_TRUE(flight.run_until(is_done, 300)) << flight.story();
  EXPECT_FALSE(flight.was_told("Failsafe activated")) << flight.story();
  EXPECT_EQ(flaw_of_reports(flight), "") << flight.story();
}

INSTANTIATE_TEST_SUITE_P(every_vehicle, idle_sticks,
                         testing::Values(sim::personality::rover, sim::personality::px4, sim::personality::ardupilot),
                         [](const auto& who) { return std::string(io::name_of(who.param)); });

} // namespace station_people_test
