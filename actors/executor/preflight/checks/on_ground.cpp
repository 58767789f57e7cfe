#include "actors/executor/preflight/checks/on_ground.hpp"

namespace godwit::executor::preflight {

result look_at_on_ground(const facts& seen, const settings&) {
  if (!is_vehicle_heard(seen))
    return skipped("The vehicle is not heard: whether it stands is not known.");
  if (seen.vehicle.stands_ready_to_move)
    return fail("The vehicle stands armed in a mode in which it goes off by itself, and godwit has not started it: "
                "disarm it, or put it into its hold mode. Nothing is brought to it before.");
  if (seen.vehicle.is_moving)
    return fail("The vehicle is under way, and godwit has not started it; nothing is brought to it before it stands.");
  return pass("The vehicle stands.");
}

} // namespace godwit::executor::preflight
