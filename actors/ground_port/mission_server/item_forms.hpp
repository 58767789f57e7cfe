// The forms of an item: as integers, as floats (the deprecated message), and as a vehicle keeps it. Thread: pure.
#pragma once

#include "actors/ground_port/mission_server/server_profile.hpp"

namespace godwit::ground_port::mission_server {

// The float form has degrees in the global frames, none of which is an `_int` one, and loses what a float can not hold
// (about 1 m of longitude).
[[nodiscard]] mavlink::mission_item_int in_integers(const mavlink::mission_item& item);
[[nodiscard]] mavlink::mission_item in_floats(const mavlink::mission_item_int& item);

// ITEM without address, as VEHICLE keeps it.
[[nodiscard]] mavlink::mission_item_int as_kept(mavlink::mission_item_int item, const server_profile& vehicle);

} // namespace godwit::ground_port::mission_server
