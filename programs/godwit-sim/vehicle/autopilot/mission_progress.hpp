// What MISSION_CURRENT says on every vehicle alike: the item, how many there are, the ids. State and mode differ.
// Thread: pure. Source: MISSION_CURRENT (42).
#pragma once

#include "actors/ground_port/mission_server/server.hpp"
#include "io/mavlink/messages/mission.hpp"
#include "programs/godwit-sim/vehicle/autopilot/traits.hpp"
#include "programs/godwit-sim/vehicle/flight/mission_run.hpp"

namespace godwit::sim {

[[nodiscard]] mavlink::mission_current progress_of(const mission_run& run, const plans::server& held,
                                                   const traits& habits);

} // namespace godwit::sim
