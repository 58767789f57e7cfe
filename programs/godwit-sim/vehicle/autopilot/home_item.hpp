// Home as item 0 of the mission of an ArduPilot. Thread: pure.
#pragma once

#include "io/mavlink/messages/mission_transfer.hpp"
#include "programs/godwit-sim/vehicle/autopilot/names.hpp"
#include "programs/godwit-sim/vehicle/world/position.hpp"

namespace godwit::sim {

// KEPT, as the autopilot keeps it, at this place.
[[nodiscard]] mavlink::mission_item_int home_item(mavlink::mission_item_int kept, const position& home);

} // namespace godwit::sim
