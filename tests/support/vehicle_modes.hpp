// The modes that people take in the drills (programs/godwit-drill), for tests of the actors too.
#pragma once

#include "programs/godwit-drill/flight_simulation/vehicle_modes.hpp"

namespace godwit::tests {

using namespace godwit::drill;

} // namespace godwit::tests
