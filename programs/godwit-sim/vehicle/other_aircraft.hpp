// The aircraft that the simulated ADS-B receiver of a vehicle reports: each flies straight past the vehicle's home,
// from 4 km before it to 4 km after it, again and again. Every third is a plain transponder, of which neither altitude
// nor course nor speed is known.
//
// World seconds, metres, degrees. Pure: the same index and time are the same report. Thread: any.
#pragma once

#include "io/mavlink/messages/traffic.hpp"
#include "programs/godwit-sim/vehicle/world/position.hpp"

namespace godwit::sim {

inline constexpr int max_other_aircraft = 100;

// That with INDEX, from 0 on.
[[nodiscard]] io::mavlink::adsb_vehicle other_aircraft(const position& home, int index, double world_s);

} // namespace godwit::sim
