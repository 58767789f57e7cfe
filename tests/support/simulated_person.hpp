// The person of the drills (programs/godwit-drill), who is in tests of the actors too.
#pragma once

#include "programs/godwit-drill/flight_simulation/simulated_person.hpp"

namespace godwit::tests {

using namespace godwit::drill;

} // namespace godwit::tests
