#include "actors/executor/preflight/checks/on_ground.hpp"

namespace godwit::executor::preflight {

result look_at_on_ground(const facts& seen, const settings&) {
  if (!is_vehicle_heard(seen))
    return skipped("The vehicle is not heard: whether it stands is not known.");
  if (seen.vehicle.is_moving)
    return fail("The vehicle is under way, and godwit has not started it; nothing is brought to it before it stands.");
  return pass("The vehicle stands.");
}

} // namespace godwit::executor::preflight
