#include "actors/executor/preflight/checks/autopilot_checks.hpp"

#include <algorithm>

#include "io/mavlink/enums.hpp"

namespace godwit::executor::preflight {
namespace {

// By its RTL_AUTOLAND, which is 0 unless somebody sets it, an ArduPilot plane is not armed with a DO_LAND_START.
bool marks_landing(const facts& seen) {
  using io::mavlink::mav_autopilot;
  if (seen.vehicle.autopilot != mav_autopilot::ardupilotmega ||
      seen.vehicle.what != flight::vehicle_class::fixed_wing || seen.mission.plans == nullptr || !*seen.mission.plans)
    return false;
  return std::ranges::any_of(**seen.mission.plans, [](const plan::flight_plan& each) {
    return std::ranges::any_of(each.items, [](const io::mavlink::mission_item_int& item) {
      return item.command == io::mavlink::number(io::mavlink::mav_cmd::do_land_start);
    });
  });
}

result failing(const facts& seen) {
  const auto& words = seen.vehicle.why_not_armed;
  if (marks_landing(seen) &&
      ((words.empty() && seen.mission.is_brought) || words.find("RTL_AUTOLAND") != std::string::npos))
    return fail(std::string(words.empty()
                                ? "The autopilot's own checks fail, and it does not report which; it may be this: "
                                : "") +
                "The plan marks its landing with DO_LAND_START, and a plane is armed with such a plan only when its "
                "RTL_AUTOLAND is set. Set RTL_AUTOLAND to 3 in the vehicle, or flight.marks_landings to false." +
                in_its_words(seen));
  return fail("The autopilot's own checks fail; its messages at the ground station say which." + in_its_words(seen));
}

} // namespace

result look_at_autopilot_checks(const facts& seen, const settings&) {
  if (!is_vehicle_heard(seen))
    return skipped("The vehicle is not heard: what its autopilot's own checks say is not known.");
  switch (seen.vehicle.own) {
  case own_checks::passing:
    return pass("The autopilot's own checks pass.");
  case own_checks::failing:
    return failing(seen);
  case own_checks::not_told:
    return degraded("The autopilot does not report whether its own checks pass; look at its messages.");
  case own_checks::unknown:
    break;
  }
  return fail("Nothing was heard of the autopilot's own checks yet; wait until the vehicle reports its state.");
}

own_checks own_checks_of(const io::mavlink::sys_status& told, io::mavlink::mav_autopilot autopilot) {
  if ((told.onboard_control_sensors_health & prearm_check_bit) != 0)
    return own_checks::passing;
  const bool has_them =
      (told.onboard_control_sensors_enabled & prearm_check_bit) != 0 || autopilot == io::mavlink::mav_autopilot::px4;
  return has_them ? own_checks::failing : own_checks::not_told;
}

} // namespace godwit::executor::preflight
