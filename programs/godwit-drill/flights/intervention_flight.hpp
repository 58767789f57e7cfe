// A flight in which people act within a second of godwit's orders, drawn from a seed: they disarm, change the mode in
// each form in which stations send it, bring another plan of the same length, choose an item, move home. They do it on
// godwit's line, on another line, or through a ground station at godwit's port.
//
// The world runs as fast as time: heartbeats come each second, as of real vehicles. What must hold is people_audit and
// the judges of every flight. Its acts are numbered from 1 and 0 is a bad line, as the faults of random flights.
// Thread: one.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "programs/godwit-drill/flights/watched_flight.hpp"

namespace godwit::drill {

inline constexpr std::uint64_t most_interventions = 3; // of one flight, besides its line

[[nodiscard]] flight_outcome fly_intervention(std::uint64_t seed, std::optional<sim::personality> who,
                                              const flight_wishes& wishes,
                                              const std::vector<std::uint64_t>& without = {});

} // namespace godwit::drill
