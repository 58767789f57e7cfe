#include "actors/executor/preflight/checks/vehicle_kind.hpp"

#include <string>

namespace godwit::executor::preflight {

namespace {

// The number of an autopilot comes from the air: one without a name is possible.
bool is_known(io::mavlink::mav_autopilot autopilot) {
  return autopilot != io::mavlink::mav_autopilot::invalid && !io::name_of(autopilot).empty();
}

} // namespace

result look_at_vehicle_kind(const facts& seen, const settings&) {
  if (!is_vehicle_heard(seen))
    return skipped("The vehicle is not heard: what it is, is not known.");
  if (seen.vehicle.what == flight::vehicle_class::unknown)
    return fail(
        "The vehicle is no multirotor, fixed wing or rover; look at the frame type that is set in its autopilot.");
  if (!is_known(seen.vehicle.autopilot))
    return fail("The vehicle's autopilot is none that is known (number " +
                std::to_string(static_cast<int>(seen.vehicle.autopilot)) + "); PX4 and ArduPilot are.");
  return pass("The vehicle is a " + std::string(io::name_of(seen.vehicle.what)) + " with the autopilot " +
              std::string(io::name_of(seen.vehicle.autopilot)) + ".");
}

} // namespace godwit::executor::preflight
