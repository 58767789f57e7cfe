// The mission of the drills (programs/godwit-drill), which tests of the actors fly too.
#pragma once

#include "programs/godwit-drill/flight_simulation/short_mission.hpp"

namespace godwit::tests {

using namespace godwit::drill;

} // namespace godwit::tests
