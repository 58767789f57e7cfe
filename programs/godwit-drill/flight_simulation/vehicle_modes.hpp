// Modes of the simulated vehicles, as HEARTBEAT.custom_mode, that people and godwit take. Thread: pure.
#pragma once

#include <array>
#include <cstdint>

#include "actors/domain/flight_mode/flight_modes.hpp"
#include "io/mavlink/enums.hpp"
#include "io/mavlink/messages.hpp"
#include "programs/godwit-sim/vehicle/autopilot/mode_table.hpp"
#include "programs/godwit-sim/vehicle/personality.hpp"

namespace godwit::drill {

[[nodiscard]] inline sim::mode_table modes_of(sim::personality who) {
  switch (who) {
  case sim::personality::rover:
    return sim::rover_modes();
  case sim::personality::px4:
  case sim::personality::px4_vtol:
    return sim::px4_modes();
  case sim::personality::ardupilot:
    return sim::copter_modes();
  case sim::personality::plane:
    return sim::plane_modes();
  case sim::personality::quadplane:
    return sim::quadplane_modes();
  case sim::personality::ardurover:
    return sim::ardurover_modes();
  }
  return {};
}

// Whose modes they are.
[[nodiscard]] inline flight::mode_owner owner_of(sim::personality who) {
  using flight::vehicle_class;
  using io::mavlink::mav_autopilot;
  switch (who) {
  case sim::personality::px4:
    return {mav_autopilot::px4, vehicle_class::multirotor};
  case sim::personality::px4_vtol:
    return {mav_autopilot::px4, vehicle_class::fixed_wing};
  case sim::personality::ardupilot:
    return {mav_autopilot::ardupilotmega, vehicle_class::multirotor};
  case sim::personality::plane:
    return {mav_autopilot::ardupilotmega, vehicle_class::fixed_wing};
  case sim::personality::quadplane:
    return {mav_autopilot::ardupilotmega, vehicle_class::fixed_wing};
  case sim::personality::ardurover:
    return {mav_autopilot::ardupilotmega, vehicle_class::rover};
  case sim::personality::rover:
    break;
  }
  return {mav_autopilot::generic, vehicle_class::rover};
}

// In which a pilot flies, or drives, by hand: PX4's position control, STABILIZE of a copter, MANUAL of the others.
[[nodiscard]] inline std::uint32_t pilot_mode(sim::personality who) {
  return who == sim::personality::px4 ? 0x0003'0000 : 0;
}

// In which it stays where it is: also what a pilot takes for that.
[[nodiscard]] inline std::uint32_t hold_mode(sim::personality who) {
  constexpr std::array modes{4U, 0x0304'0000U, 5U, 12U, 4U, 12U, 0x0304'0000U}; // by personality
  return modes.at(static_cast<std::size_t>(who));
}

// Of PX4 and a copter.
[[nodiscard]] inline std::uint32_t landing_mode(sim::personality who) {
  return who == sim::personality::px4 ? 0x0604'0000 : 9;
}

[[nodiscard]] inline std::uint32_t mission_mode(sim::personality who) {
  constexpr std::array modes{10U, 0x0404'0000U, 3U, 10U, 10U, 10U, 0x0404'0000U}; // by personality
  return modes.at(static_cast<std::size_t>(who));
}

// A command as stations send it: COMMAND_LONG to the autopilot 1/1. Thread: any.
[[nodiscard]] inline io::mavlink::command_long autopilot_command(io::mavlink::mav_cmd what, float param1, float param2,
                                                                 float param3, float param7) {
  io::mavlink::command_long result;
  result.target_system = 1;
  result.target_component = 1;
  result.command = io::mavlink::number(what);
  result.param1 = param1;
  result.param2 = param2;
  result.param3 = param3;
  result.param7 = param7;
  return result;
}

} // namespace godwit::drill
