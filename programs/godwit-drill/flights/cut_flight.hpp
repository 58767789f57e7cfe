// Cuts the line, both ways or one, as the vehicle is armed, started, held for another plan, paused, resumed or called
// home, drawn from a seed: what the vehicle does then nobody hears. A person may take it meanwhile, arm or disarm it,
// and the executor or the process may end.
//
// What happens is numbered: 0 is a bad line, 1 and up are the cuts, each with all that goes with it. Each is drawn for
// itself, so that a flight can be flown again without some of them and the others stay as they were. Thread: one.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "programs/godwit-drill/flights/watched_flight.hpp"

namespace godwit::drill {

inline constexpr std::uint64_t most_cuts = 3; // of one flight

// WHO: PX4 or one of ArduPilot's Copter and Rover when none is named; a seed flies another flight then. WITHOUT: these.
[[nodiscard]] flight_outcome fly_cut(std::uint64_t seed, std::optional<sim::personality> who,
                                     const flight_wishes& wishes, const std::vector<std::uint64_t>& without = {});

} // namespace godwit::drill
