#include "actors/executor/preflight/checks/home.hpp"

namespace godwit::executor::preflight {

result look_at_home(const facts& seen, const settings&) {
  if (!is_vehicle_heard(seen))
    return skipped("The vehicle is not heard: whether it has a home is not known.");
  if (!seen.vehicle.is_home_known)
    return fail("The vehicle has no home to return to; wait until it has set one, or set it at the ground station.");
  return pass("The vehicle knows its home.");
}

} // namespace godwit::executor::preflight
