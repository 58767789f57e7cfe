// Any order of kills, throws, pilots, pauses, assignments, cut lines and faults of the service, drawn from a seed.
//
// One seed in ten flies a survey in which something is seen and decided, and one in a hundred a long mission.
//
// Its faults are numbered: 0 is a bad line, 1 and up are what happens one after the other. Each is drawn for itself, so
// that a flight can be flown again without some of them and the others stay as they were. Thread: one.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "programs/godwit-drill/flights/watched_flight.hpp"

namespace godwit::drill {

inline constexpr std::uint64_t most_faults = 7; // of one flight

// WHO: any of the vehicles that random flights know, when none is named; a seed flies another flight then. WITHOUT:
// these faults.
[[nodiscard]] flight_outcome fly_random(std::uint64_t seed, std::optional<sim::personality> who,
                                        const flight_wishes& wishes, const std::vector<std::uint64_t>& without = {});

} // namespace godwit::drill
