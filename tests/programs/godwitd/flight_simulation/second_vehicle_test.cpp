// Two vehicles on one line, and the process is killed in flight while its own is silent: it waits for that one, and
// what people say meanwhile arms and flies nobody else.
#include <gtest/gtest.h>

#include "io/mavlink/enums.hpp"
#include "io/mavlink/messages.hpp"
#include "programs/godwit-drill/flight_simulation/flight_judge.hpp"
#include "programs/godwit-drill/flight_simulation/flight_people.hpp"

namespace second_vehicle_test {

using namespace godwit;
using namespace godwit::drill;
using executor::phase;
using operators::command_kind;
namespace mavlink = io::mavlink;
using line = flight_simulation::target_line;

constexpr mavlink::sender second{2, 1};

// Standing, disarmed, in a mode of a person.
mavlink::heartbeat standing() {
  return {.type = mavlink::number(mavlink::mav_type::quadrotor),
          .autopilot = mavlink::number(mavlink::mav_autopilot::ardupilotmega),
          .base_mode = 1,
          .system_status = mavlink::number(mavlink::mav_state::standby)};
}

class second_vehicle : public testing::TestWithParam<sim::personality> {
protected:
  void hear_it_alone(double seconds) {
    flight.cut_line(seconds);
    for (double passed = 0; passed < seconds; passed += 0.2) {
      flight.forge(line::vehicle, standing(), second);
      flight.run_for(0.2);
    }
  }

  flight_simulation flight{{.who = GetParam()}};
};

TEST_P(second_vehicle, is_not_taken_for_the_one_that_is_flown_after_a_kill) {
  ASSERT_TRUE(flight.run_until([&] { return !flight.reports().empty(); }, 120)) << flight.story();
  flight.kill_process();
  flight.run_for(0.5);
  hear_it_alone(4);
  for (const auto word : {command_kind::hand_back, command_kind::resume, command_kind::start})
    flight.say(word);
  hear_it_alone(2);
  EXPECT_FALSE(flight.was_told("a pilot has the vehicle")) << flight.story();
  EXPECT_TRUE(flight.status().in_flight) << flight.story();
  EXPECT_TRUE(fly_with_help(flight)) << flight.story();
  EXPECT_EQ(flaw_of_reports(flight), "") << flight.story();
}

INSTANTIATE_TEST_SUITE_P(every_vehicle, second_vehicle,
                         testing::Values(sim::personality::rover, sim::personality::px4, sim::personality::ardupilot),
                         [](const auto& who) { return std::string(io::name_of(who.param)); });

} // namespace second_vehicle_test
