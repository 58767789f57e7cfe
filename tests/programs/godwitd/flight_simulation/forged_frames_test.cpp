// Somebody on the network sends one to three frames under the name of the vehicle, of its autopilot or of a ground
// station, on lines without a key. Nothing is taken over, restarted, returned, stood down or started by them.
#include <gtest/gtest.h>

#include "io/mavlink/enums.hpp"
#include "io/mavlink/messages.hpp"
#include "programs/godwit-drill/flight_simulation/flight_judge.hpp"
#include "programs/godwit-drill/flight_simulation/flight_people.hpp"
#include "programs/godwit-drill/flight_simulation/forged_frames.hpp"

namespace forged_frames_test {

using namespace godwit;
using namespace godwit::drill;
using executor::phase;
namespace mavlink = io::mavlink;
using line = flight_simulation::target_line;

constexpr mavlink::sender autopilot{1, 1};

mavlink::heartbeat of_station() {
  return {.type = mavlink::number(mavlink::mav_type::gcs),
          .autopilot = mavlink::number(mavlink::mav_autopilot::invalid)};
}

class forged_frames : public testing::TestWithParam<sim::personality> {
protected:
  flight_simulation flight{{.who = GetParam()}};

  void fly() { ASSERT_TRUE(flight.run_until_phase(phase::flying, 120)) << flight.story(); }
  template <class M>
  void three(line where, const M& what, mavlink::sender as, double apart_s) {
    for (int i = 0; i < 3; ++i) {
      flight.forge(where, what, as);
      flight.run_for(apart_s);
    }
  }
  // It goes on as if nothing had been: the mission is flown to its end, and no order was sent but those that fly it.
  void expect_no_effect() {
    EXPECT_FALSE(flight.was_told("paused")) << flight.story();
    EXPECT_TRUE(flight.run_until_phase(phase::done, 300)) << flight.story();
    EXPECT_EQ(flaw_of_reports(flight), "") << flight.story();
    EXPECT_FALSE(flight.was_told("paused")) << flight.story();
    EXPECT_FALSE(flight.was_told("return")) << flight.story();
  }
};

TEST_P(forged_frames, a_heartbeat_in_a_pilots_mode_takes_nothing_over) {
  fly();
  three(line::vehicle, piloted(GetParam()), autopilot, 0.3);
  expect_no_effect();
}

TEST_P(forged_frames, a_young_clock_is_no_restart_of_the_autopilot) {
  fly();
  for (std::uint32_t i = 1; i <= 3; ++i) {
    flight.forge(line::vehicle, just_started(i), autopilot);
    flight.run_for(0.6);
  }
  expect_no_effect();
}

TEST_P(forged_frames, a_position_outside_of_the_fence_brings_nobody_home) {
  fly();
  three(line::vehicle, far_away(), autopilot, 0.1);
  expect_no_effect();
}

TEST_P(forged_frames, another_autopilot_that_is_heard_first_does_not_keep_the_vehicle_away) {
  three(line::vehicle, piloted(GetParam()), {66, 1}, 0.01);
  EXPECT_TRUE(flight.run_until_phase(phase::done, 300)) << flight.story();
}

TEST_P(forged_frames, no_order_goes_to_who_speaks_as_the_vehicle) {
  fly();
  flight.process()->vehicle_wire().note_receivers();
  for (int i = 0; i < 20; ++i) {
    flight.forge(line::vehicle, piloted(GetParam()), autopilot);
    flight.run_for(0.05);
  }
  EXPECT_EQ(flight.process()->vehicle_wire().sent_to(flight_simulation::stranger), 0U);
  expect_no_effect();
}

TEST_P(forged_frames, a_ground_stations_heartbeat_is_no_operator_whose_loss_would_matter) {
  flight.station().fall_silent(); // and never was there
  fly();
  three(line::ground, of_station(), {99, 99}, 1.0);
  expect_no_effect();
}

TEST_P(forged_frames, a_start_of_nobody_starts_nothing) {
  flight_simulation waits({.who = GetParam(), .starts_by_itself = false});
  ASSERT_TRUE(waits.run_until_phase(phase::ready, 120)) << waits.story();
  for (const auto as : {mavlink::sender{0, 0}, mavlink::sender{0, 190}, mavlink::sender{255, 0}})
    waits.forge(line::ground,
                mavlink::command_long{.target_system = 1, .command = mavlink::number(mavlink::mav_cmd::mission_start)},
                as);
  waits.run_for(20);
  EXPECT_EQ(waits.status().now, phase::ready) << waits.story();
  EXPECT_FALSE(waits.vehicle().describe().armed);
}

INSTANTIATE_TEST_SUITE_P(every_vehicle, forged_frames,
                         testing::Values(sim::personality::rover, sim::personality::px4, sim::personality::ardupilot),
                         [](const auto& who) { return std::string(io::name_of(who.param)); });

} // namespace forged_frames_test
