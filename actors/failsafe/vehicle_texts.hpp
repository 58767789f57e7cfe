// What an action is called in MAVLink.
//
// Return and landing have commands of their own, that PX4 and ArduPilot obey alike. Hold is a mode, by DO_SET_MODE; so
// a change of mode by somebody else that still waits for its answer would be in its way. SET_MODE then says the same,
// without an answer. Thread: pure. Source: MAVLink's common.xml, MAV_CMD.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "actors/domain/flight_mode/flight_modes.hpp"
#include "actors/failsafe/battery_filter.hpp"
#include "actors/failsafe/fence_watch.hpp"
#include "actors/failsafe/reaction.hpp"
#include "actors/failsafe/rules.hpp"
#include "messages/vehicle_link/command.hpp"

namespace godwit::failsafe {

// None: this vehicle has no mode that means it.
[[nodiscard]] std::optional<vehicle_link::send_command> words_for(const command_vehicle& wanted,
                                                                  const flight::mode_owner& whose);

// The same as a SET_MODE. None: it is no mode, or as above.
[[nodiscard]] std::optional<vehicle_link::set_mode> mode_words_for(const command_vehicle& wanted,
                                                                   const flight::mode_owner& whose);

// The exact modes that obey it.
[[nodiscard]] std::vector<std::uint32_t> modes_for(action what, const flight::mode_owner& whose);

// What the failsafes say to people. Thread: pure.

// "the battery is at 14 %"
[[nodiscard]] std::string cause_of(rule why, const battery_verdict& level, const fence_verdict& fences);

// "the vehicle lands"
[[nodiscard]] std::string deed_of(action what);

} // namespace godwit::failsafe
