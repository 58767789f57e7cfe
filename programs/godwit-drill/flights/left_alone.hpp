// A person has just taken the vehicle of a flight: godwit must see it, and command nothing from then on. Thread: one.
#pragma once

#include "programs/godwit-drill/flights/watched_flight.hpp"

namespace godwit::drill {

// Into the mode in which a pilot flies, or drives, by hand. False: it is in that one already, and nobody can see it.
[[nodiscard]] bool take_by_hand(flight_simulation& flight);

// MUST_SEE: else it is enough that nothing is commanded, as on the ground.
void expect_left_alone(watched_flight& watched, bool must_see = true);

} // namespace godwit::drill
