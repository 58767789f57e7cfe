// Would a vehicle take this item? Thread: pure.
#pragma once

#include "actors/ground_port/mission_server/autopilot_quirks.hpp"

namespace godwit::ground_port::mission_server {

// `accepted`, or what is wrong with it: a command that is no item of such a plan, a frame that the vehicle does not
// know, or a position that is not on earth. Only what has a position is judged by it.
[[nodiscard]] mavlink::mav_mission_result check_item(const mavlink::mission_item_int& item,
                                                     const autopilot_quirks& vehicle);

} // namespace godwit::ground_port::mission_server
