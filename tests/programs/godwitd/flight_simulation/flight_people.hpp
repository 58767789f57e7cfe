// The people around a flight, as far as a flight needs them to come to its end. Thread: one.
#pragma once

#include <cstdint>

#include "programs/godwit-sim/vehicle/personality.hpp"
#include "tests/programs/godwitd/flight_simulation/flight_simulation.hpp"

namespace godwit::tests {

// A mode in which a pilot flies, or drives, by hand.
[[nodiscard]] std::uint32_t pilot_mode(sim::personality who);

// Lets it fly until it is at rest and the service knows. Whoever stands beside it hands it back and says
// that it is to go on when it waits for a person, and changes the battery on the ground. False: it does not come to an
// end.
[[nodiscard]] bool fly_with_help(flight_simulation& flight);

} // namespace godwit::tests
