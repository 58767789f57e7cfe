// What MISSION_CURRENT says. Thread: pure. Source: MISSION_CURRENT (42).
#pragma once

#include "actors/ground_port/mission_server/server.hpp"
#include "io/mavlink/messages/mission.hpp"
#include "programs/godwit-sim/vehicle/autopilot/traits.hpp"
#include "programs/godwit-sim/vehicle/flight/mission_run.hpp"

namespace godwit::sim {

// What is alike on every vehicle: the item, how many there are, the ids. State and mode are not filled in.
[[nodiscard]] mavlink::mission_current place_in_mission(const mission_run& run, const plans::server& held,
                                                        const traits& vehicle_traits);

// All of it, for a vehicle whose mission waits where it is while another mode flies.
[[nodiscard]] mavlink::mission_current progress_of(const mission_run& run, const plans::server& held,
                                                   const traits& vehicle_traits, bool is_in_mission_mode);

} // namespace godwit::sim
