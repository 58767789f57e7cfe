// Any order of kills, throws, pilots, pauses, assignments, cut lines and faults of the service, drawn from a seed.
// Thread: one.
#pragma once

#include <cstdint>
#include <optional>

#include "programs/godwit-drill/flights/watched_flight.hpp"

namespace godwit::drill {

// WHO: any of the vehicles that random flights know, when none is named; a seed flies another flight then.
[[nodiscard]] flight_outcome fly_random(std::uint64_t seed, std::optional<sim::personality> who,
                                        const flight_wishes& wishes);

} // namespace godwit::drill
