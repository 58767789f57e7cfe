#include "actors/executor/preflight/checks/vehicle_ready.hpp"

#include "io/mavlink/messages/estimator.hpp"

namespace godwit::executor::preflight {

namespace {

// A Plane without a compass finds its heading in the take-off run, and says so by a flag that is missing on the ground.
bool may_align_in_flight(const facts& seen) {
  return seen.vehicle.autopilot == io::mavlink::mav_autopilot::ardupilotmega &&
         seen.vehicle.what == flight::vehicle_class::fixed_wing && seen.vehicle.own == own_checks::passing;
}

} // namespace

result look_at_vehicle_ready(const facts& seen, const settings&) {
  if (!is_vehicle_heard(seen))
    return skipped("The vehicle is not heard: whether its position estimate is ready is not known.");
  switch (seen.vehicle.estimate) {
  case estimate::ready:
    return pass("The vehicle's position estimate is ready.");
  case estimate::not_ready:
    if (may_align_in_flight(seen))
      return degraded(
          "The vehicle's position estimate is not ready, though its own checks pass; without a compass it is "
          "aligned in the take-off. Acknowledge it if that is so, else wait.");
    return fail("The vehicle can not be armed for a flight yet, because its position estimate is not ready; wait until "
                "it is." +
                in_its_words(seen));
  case estimate::not_told:
    return skipped("The vehicle does not report whether its position estimate is ready; look at its messages.");
  case estimate::unknown:
    break;
  }
  return fail("Nothing was heard of the vehicle's position estimate yet; wait until it is reported.");
}

estimate estimate_of(std::uint16_t flags) {
  return (flags & io::mavlink::estimator_pos_horiz_abs) != 0 ? estimate::ready : estimate::not_ready;
}

bool tells_estimate(io::mavlink::mav_autopilot autopilot) {
  return autopilot == io::mavlink::mav_autopilot::ardupilotmega || autopilot == io::mavlink::mav_autopilot::px4;
}

} // namespace godwit::executor::preflight
