// The people around a flight, as far as a flight needs them to come to its end. Thread: one.
#pragma once

#include "programs/godwit-drill/flight_simulation/flight_simulation.hpp"
#include "programs/godwit-drill/flight_simulation/vehicle_modes.hpp"

namespace godwit::drill {

// A process whose journal was lost knows from the service that the mission has ended.
[[nodiscard]] bool has_nothing_to_fly(const flight_simulation& flight);

// What is left of its mission can not be flown from where it stands: no word but another mission helps.
[[nodiscard]] bool waits_for_another_mission(const flight_simulation& flight);

// It stands armed in its mission mode, by somebody else or by an order that came too late: a person disarms it first.
[[nodiscard]] bool waits_for_disarm(const flight_simulation& flight);

// Lets it fly until it is at rest and the service knows. Whoever stands beside it hands it back and says
// that it is to go on when it waits for a person, acknowledges what preflight asks about, disarms what stands ready to
// move, and changes the battery on the ground. False: it does not come to an end, or waits for another mission.
[[nodiscard]] bool fly_with_help(flight_simulation& flight);

// A station starts the mission, again until it is under way: what is under way in godwit is a reason to be refused.
// False: it does not begin.
[[nodiscard]] bool start_by_station(flight_simulation& flight);

} // namespace godwit::drill
