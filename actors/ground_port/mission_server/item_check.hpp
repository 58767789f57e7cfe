// Would a vehicle take this item? Thread: pure.
#pragma once

#include "actors/ground_port/mission_server/habits.hpp"

namespace godwit::ground_port::mission_server {

// `accepted`, or what is wrong with it: a command, a frame or a position that the vehicle does not know.
[[nodiscard]] mavlink::mav_mission_result check_item(const mavlink::mission_item_int& item, const habits& vehicle);

} // namespace godwit::ground_port::mission_server
