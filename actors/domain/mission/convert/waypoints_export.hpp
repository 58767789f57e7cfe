// A mission as a plan file of lines (`QGC WPL 110`): the return point as home position in the first line, then the
// items.
//
// The file keeps seven decimals of a degree and single precision for the rest. Losses: surveys, geofences, the height
// of the return point. Thread: pure.
#pragma once

#include "actors/domain/mission/convert/conversion.hpp"

namespace godwit::mission {

// MISSION keeps all rules.
[[nodiscard]] exported export_waypoints(const document& mission);

} // namespace godwit::mission
