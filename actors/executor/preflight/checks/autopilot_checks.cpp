#include "actors/executor/preflight/checks/autopilot_checks.hpp"

namespace godwit::executor::preflight {

result look_at_autopilot_checks(const facts& seen, const settings&) {
  if (!is_vehicle_heard(seen))
    return skipped("The vehicle is not heard: what its autopilot's own checks say is not known.");
  switch (seen.vehicle.own) {
  case own_checks::passing:
    return pass("The autopilot's own checks pass.");
  case own_checks::failing:
    return fail("The autopilot's own checks fail; its messages at the ground station say which." + in_its_words(seen));
  case own_checks::not_told:
    return degraded("The autopilot does not say whether its own checks pass; look at its messages.");
  case own_checks::unknown:
    break;
  }
  return fail("Nothing was heard of the autopilot's own checks yet; wait until the vehicle tells its state.");
}

own_checks own_checks_of(const io::mavlink::sys_status& told, io::mavlink::mav_autopilot autopilot) {
  if ((told.onboard_control_sensors_health & prearm_check_bit) != 0)
    return own_checks::passing;
  const bool has_them =
      (told.onboard_control_sensors_enabled & prearm_check_bit) != 0 || autopilot == io::mavlink::mav_autopilot::px4;
  return has_them ? own_checks::failing : own_checks::not_told;
}

} // namespace godwit::executor::preflight
