// Of the vehicle and the line to it.
#include "actors/executor/preflight/checks.hpp"

#include <algorithm>
#include <cstdint>
#include <string>

#include "io/mavlink/enums.hpp"
#include "io/mavlink/messages/vehicle_status.hpp"
#include "io/time_units.hpp"

namespace godwit::executor::preflight {

namespace {

// Whichever was switched on first would be flown.
std::string named(const vehicle_link::line_findings& line) {
  std::string result = "system " + std::to_string(line.vehicle->system);
  for (const auto& each : line.others)
    result += " and system " + std::to_string(each.system);
  return result;
}

// With the semicolon before it; empty: nothing.
std::string heard_instead_of_it(const std::string& reason) {
  const auto at = reason.find(vehicle_link::heard_instead);
  return at == std::string::npos ? std::string() : reason.substr(at);
}

} // namespace

result check_vehicle_link(const facts& seen, const settings&) {
  using vehicle_link::connection_phase;
  if (seen.vehicle.link != connection_phase::connected &&
      seen.vehicle.link_reason.starts_with(vehicle_link::refused_for_signature))
    return fail("The vehicle speaks and is not believed: " + seen.vehicle.link_reason +
                "; give both the same key, and set their clocks.");
  switch (seen.vehicle.link) {
  case connection_phase::connected:
    if (!seen.vehicle.line.twin.empty())
      return fail(seen.vehicle.line.twin);
    if (seen.vehicle.line.vehicle && !seen.vehicle.line.others.empty() && !seen.vehicle.line.is_chosen)
      return fail("More than one autopilot is heard on the line: " + named(seen.vehicle.line) +
                  ". Set vehicle.system to the id of yours, and start godwitd again.");
    return pass("The vehicle is heard.");
  case connection_phase::silent:
    return fail("No autopilot is heard on the link" + heard_instead_of_it(seen.vehicle.link_reason) +
                "; switch the vehicle on, and check the baud rate of the line.");
  case connection_phase::lost:
    return fail("The vehicle is not heard any more; check its power and its cable or radio.");
  case connection_phase::down:
    break;
  }
  return fail("The link to the vehicle is not open; check the configured device or address.");
}

namespace {

constexpr std::string_view beginning = "The line to vehicle ";

} // namespace

result check_open_line(const facts& seen, const settings& set) {
  if (!is_vehicle_heard(seen))
    return skipped("The vehicle is not heard: whether others can send on its line was not checked.");
  if (set.open_line.empty())
    return pass("The line to the vehicle has a key, or does not leave it.");
  const auto system = seen.vehicle.line.vehicle ? seen.vehicle.line.vehicle->system : std::uint8_t{0};
  return degraded(std::string(beginning) + std::to_string(system) + ", " + set.open_line +
                  ", has no key: whoever is in its network can take the flight, or send the vehicle home. Only a key "
                  "ends that (vehicle.key_file, godwitd ctl sign); or acknowledge once that this vehicle flies so.");
}

bool is_about_open_line(std::string_view sentence) { return sentence.starts_with(beginning); }

namespace {

// The number of an autopilot comes from the air: one without a name is possible.
bool is_known(io::mavlink::mav_autopilot autopilot) {
  return autopilot != io::mavlink::mav_autopilot::invalid && !io::name_of(autopilot).empty();
}

} // namespace

result check_vehicle_kind(const facts& seen, const settings&) {
  if (!is_vehicle_heard(seen))
    return skipped("The vehicle is not heard: what it is, is not known.");
  if (seen.vehicle.what == flight::vehicle_class::unknown)
    return fail("The vehicle is no multirotor, fixed wing or rover; check the frame type in its autopilot.");
  if (!is_known(seen.vehicle.autopilot))
    return fail("The vehicle's autopilot is none that is known (number " +
                std::to_string(static_cast<int>(seen.vehicle.autopilot)) + "); PX4 and ArduPilot are.");
  return pass("The vehicle is a " + std::string(io::name_of(seen.vehicle.what)) + " with the autopilot " +
              std::string(io::name_of(seen.vehicle.autopilot)) + ".");
}

namespace {

bool is_in_three_dimensions(io::mavlink::gps_fix_type fix) {
  using io::mavlink::gps_fix_type;
  switch (fix) {
  case gps_fix_type::fix_3d:
  case gps_fix_type::dgps:
  case gps_fix_type::rtk_float:
  case gps_fix_type::rtk_fixed:
  case gps_fix_type::ppp:
    return true;
  case gps_fix_type::no_gps:
  case gps_fix_type::no_fix:
  case gps_fix_type::fix_2d:
  case gps_fix_type::fixed_position:
    break;
  }
  return false;
}

} // namespace

result check_position(const facts& seen, const settings& set) {
  if (!is_vehicle_heard(seen))
    return skipped("The vehicle is not heard: where it is, is not known.");
  const auto& now = seen.vehicle;
  if (now.fix == io::mavlink::gps_fix_type::fixed_position)
    return fail("The vehicle's satellite receiver is set up as a base station; set it up for a vehicle.");
  if (!is_in_three_dimensions(now.fix))
    return fail("The vehicle has no position fix in three dimensions; wait for it under an open sky.");
  if (!now.position_age_ns || *now.position_age_ns > set.position_stale_ms * ns_per_ms)
    return fail("The vehicle reports no position, or an old one; wait until its position estimate is ready.");
  if (now.satellites && *now.satellites < set.min_satellites)
    return degraded("Fewer than " + std::to_string(set.min_satellites) +
                    " satellites are received; wait, or go where more of the sky is seen.");
  return pass("The position is known in three dimensions.");
}

result check_home(const facts& seen, const settings&) {
  if (!is_vehicle_heard(seen))
    return skipped("The vehicle is not heard: whether it has a home is not known.");
  if (!seen.vehicle.is_home_known)
    return fail("The vehicle has no home to return to; wait until it has set one, or set it at the ground station.");
  return pass("The vehicle knows its home.");
}

result check_on_ground(const facts& seen, const settings&) {
  if (!is_vehicle_heard(seen))
    return skipped("The vehicle is not heard: whether it stands is not known.");
  if (seen.vehicle.stands_ready_to_move)
    return fail("The vehicle stands armed in a mode in which it goes off by itself, and godwit has not started it: "
                "disarm it, or put it into its hold mode. Nothing is uploaded before.");
  if (seen.vehicle.is_moving)
    return fail("The vehicle is under way, and godwit has not started it; nothing is uploaded before it stands.");
  return pass("The vehicle stands.");
}

result check_battery(const facts& seen, const settings& set) {
  if (!is_vehicle_heard(seen))
    return skipped("The vehicle is not heard: what is left in its battery is not known.");
  if (!seen.vehicle.battery_percent)
    return fail("The vehicle has not reported its battery yet; wait for it.");
  const auto percent = *seen.vehicle.battery_percent;
  if (percent < 0 || percent > 100)
    return degraded("The vehicle does not know what is left in its battery, and so no failsafe will act on it; "
                    "check the settings of its power monitor, or fly only as long as is certain.");
  const auto needed = set.battery_return_percent + set.battery_margin_percent;
  if (percent <= needed)
    return fail("The battery is at " + std::to_string(percent) + " %, and more than " + std::to_string(needed) +
                " % are needed to fly; put in a charged one.");
  return pass("The battery is at " + std::to_string(percent) + " %.");
}

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

result check_autopilot_checks(const facts& seen, const settings&) {
  if (!is_vehicle_heard(seen))
    return skipped("The vehicle is not heard: what its autopilot's own checks say is not known.");
  switch (seen.vehicle.own) {
  case own_checks::passing:
    return pass("The autopilot's own checks pass.");
  case own_checks::failing:
    return failing(seen);
  case own_checks::not_told:
    return degraded("The autopilot does not report whether its own checks pass; read its messages.");
  case own_checks::unknown:
    break;
  }
  return fail("The autopilot has not reported its own checks yet; wait for it.");
}

own_checks own_checks_of(const io::mavlink::sys_status& told, io::mavlink::mav_autopilot autopilot) {
  if ((told.onboard_control_sensors_health & prearm_check_bit) != 0)
    return own_checks::passing;
  const bool has_them =
      (told.onboard_control_sensors_enabled & prearm_check_bit) != 0 || autopilot == io::mavlink::mav_autopilot::px4;
  return has_them ? own_checks::failing : own_checks::not_told;
}

namespace {

// A Plane without a compass finds its heading in the take-off run, and says so by a flag that is missing on the ground.
bool may_align_in_flight(const facts& seen) {
  return seen.vehicle.autopilot == io::mavlink::mav_autopilot::ardupilotmega &&
         seen.vehicle.what == flight::vehicle_class::fixed_wing && seen.vehicle.own == own_checks::passing;
}

} // namespace

result check_vehicle_ready(const facts& seen, const settings&) {
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
    return skipped("The vehicle does not report whether its position estimate is ready; read its messages.");
  case estimate::unknown:
    break;
  }
  return fail("The vehicle has not reported its position estimate yet; wait for it.");
}

result check_traffic(const facts& seen, const settings&) {
  const auto& [heard, close] = seen.traffic;
  if (heard.empty())
    return skipped("No other aircraft is heard; that says nothing where the vehicle has no receiver for them.");
  if (close.empty())
    return pass("No other aircraft is close. The nearest: " + heard.front() + ".");
  return pass("Another aircraft is close, wait until it has passed: " + summary_of(close) + ".");
}

estimate estimate_of(std::uint16_t flags) {
  return (flags & io::mavlink::estimator_pos_horiz_abs) != 0 ? estimate::ready : estimate::not_ready;
}

bool tells_estimate(io::mavlink::mav_autopilot autopilot) {
  return autopilot == io::mavlink::mav_autopilot::ardupilotmega || autopilot == io::mavlink::mav_autopilot::px4;
}

} // namespace godwit::executor::preflight
