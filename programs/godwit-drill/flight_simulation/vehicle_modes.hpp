// Modes of the simulated vehicles, as HEARTBEAT.custom_mode, that people and godwit take. Thread: pure.
#pragma once

#include <array>
#include <cstdint>

#include "actors/domain/flight_mode/flight_modes.hpp"
#include "io/mavlink/enums.hpp"
#include "io/mavlink/messages.hpp"
#include "programs/godwit-sim/vehicle/autopilot/mode_table.hpp"
#include "programs/godwit-sim/vehicle/autopilot/traits.hpp"
#include "programs/godwit-sim/vehicle/personality.hpp"

namespace godwit::drill {

[[nodiscard]] inline sim::mode_table modes_of(sim::personality who) { return sim::traits_of(who).modes; }

// Whose modes they are.
[[nodiscard]] inline flight::mode_owner owner_of(sim::personality who) {
  io::mavlink::heartbeat beat;
  beat.autopilot = io::mavlink::number(sim::traits_of(who).autopilot);
  beat.type = io::mavlink::number(sim::traits_of(who).type);
  return flight::owner_of(beat);
}

[[nodiscard]] inline bool is_px4(sim::personality who) {
  return sim::traits_of(who).autopilot == io::mavlink::mav_autopilot::px4;
}

// In which a pilot flies, or drives, by hand: PX4's position control, STABILIZE of a copter, MANUAL of the others.
[[nodiscard]] inline std::uint32_t pilot_mode(sim::personality who) { return is_px4(who) ? 0x0003'0000 : 0; }

// In which it stays where it is: also what a pilot takes for that.
[[nodiscard]] inline std::uint32_t hold_mode(sim::personality who) {
  constexpr std::array modes{4U, 0x0304'0000U, 5U, 12U, 4U, 12U, 0x0304'0000U}; // by personality
  return modes.at(static_cast<std::size_t>(who));
}

// Of PX4 and a copter.
[[nodiscard]] inline std::uint32_t landing_mode(sim::personality who) { return is_px4(who) ? 0x0604'0000 : 9; }

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
