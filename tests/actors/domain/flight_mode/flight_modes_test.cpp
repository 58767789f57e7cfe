#include "actors/domain/flight_mode/flight_modes.hpp"

#include <vector>

#include <gtest/gtest.h>

#include "io/mavlink/enums.hpp"

namespace godwit::flight {
namespace flight_modes_test {

using io::mavlink::mav_autopilot;
using io::mavlink::mav_type;

constexpr mode_owner px4{mav_autopilot::px4, vehicle_class::multirotor};
constexpr mode_owner copter{mav_autopilot::ardupilotmega, vehicle_class::multirotor};
constexpr mode_owner plane{mav_autopilot::ardupilotmega, vehicle_class::fixed_wing};
constexpr mode_owner rover{mav_autopilot::ardupilotmega, vehicle_class::rover};
const std::vector<mode_owner> owners{px4, copter, plane, rover};

// As recorded: PX4 in AUTO.MISSION says 0x04040000, ArduPilot's Copter in AUTO says 3, its Rover 10.
TEST(FlightModes, RecordedNumbersAreRead) {
  EXPECT_EQ(mode_of(px4, 0x04040000).kind, mode_kind::mission);
  EXPECT_EQ(mode_of(px4, 0x03040000).kind, mode_kind::hold);
  EXPECT_EQ(mode_of(px4, 0x05040000).kind, mode_kind::returning);
  EXPECT_EQ(mode_of(px4, 0x00030000).kind, mode_kind::manual);
  EXPECT_EQ(mode_of(copter, 3).kind, mode_kind::mission);
  EXPECT_EQ(mode_of(copter, 9).kind, mode_kind::landing);
  EXPECT_EQ(mode_of(rover, 10).kind, mode_kind::mission);
  EXPECT_EQ(mode_of(rover, 4).kind, mode_kind::hold);
}

TEST(FlightModes, TheSameNumberMeansWhatTheClassSays) {
  EXPECT_EQ(mode_of(copter, 4).kind, mode_kind::guided);
  EXPECT_EQ(mode_of(rover, 4).kind, mode_kind::hold);
  EXPECT_EQ(mode_of(plane, 10).kind, mode_kind::mission);
}

TEST(FlightModes, ANumberOfNobodyIsUnknown) {
  EXPECT_EQ(mode_of(px4, 99).kind, mode_kind::unknown);
  EXPECT_EQ(mode_of(copter, 99), (flight_mode{mode_kind::unknown, 99}));
  EXPECT_EQ(mode_of({mav_autopilot::generic, vehicle_class::unknown}, 10).kind, mode_kind::unknown);
}

TEST(FlightModes, WhatIsAskedForIsWhatIsReadBack) {
  for (const auto& whose : owners)
    for (const auto kind : {mode_kind::hold, mode_kind::mission, mode_kind::returning, mode_kind::guided}) {
      const auto number = number_of(whose, kind);
      ASSERT_TRUE(number);
      EXPECT_EQ(mode_of(whose, *number).kind, kind);
    }
}

TEST(FlightModes, NobodyAsksForAModeThatThereIsNot) {
  EXPECT_FALSE(number_of(rover, mode_kind::landing));
  EXPECT_FALSE(number_of(px4, mode_kind::unknown));
  EXPECT_FALSE(mode_command({mav_autopilot::px4, vehicle_class::multirotor}, mode_kind::unknown));
}

TEST(FlightModes, TheCommandHasPx4sMainAndSubModeApart) {
  const auto command = mode_command(px4, mode_kind::returning);
  ASSERT_TRUE(command);
  EXPECT_EQ(command->command, 176);
  EXPECT_EQ(command->param1, 1);
  EXPECT_EQ(command->param2, 4);
  EXPECT_EQ(command->param3, 5);
}

TEST(FlightModes, TheCommandHasArdupilotsNumberAsItIs) {
  const auto command = mode_command(copter, mode_kind::hold);
  ASSERT_TRUE(command);
  EXPECT_EQ(command->param2, 17);
  EXPECT_EQ(command->param3, 0);
}

TEST(FlightModes, AHeartbeatSaysWhoseModesTheyAre) {
  io::mavlink::heartbeat m;
  m.type = io::mavlink::number(mav_type::ground_rover);
  m.autopilot = io::mavlink::number(mav_autopilot::ardupilotmega);
  m.custom_mode = 11;
  EXPECT_EQ(owner_of(m), rover);
  EXPECT_EQ(mode_of(m).kind, mode_kind::returning);
}

} // namespace flight_modes_test
} // namespace godwit::flight
