#include "actors/executor/preflight/checks/vehicle_link.hpp"

namespace godwit::executor::preflight {
namespace {

// Whichever was switched on first would be flown.
std::string named(const vehicle_link::line_findings& line) {
  std::string result = "system " + std::to_string(line.vehicle->system);
  for (const auto& each : line.others)
    result += " and system " + std::to_string(each.system);
  return result;
}

} // namespace

result look_at_vehicle_link(const facts& seen, const settings&) {
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
    return fail("No autopilot is heard on the link; switch the vehicle on, and look at the speed of the line.");
  case connection_phase::lost:
    return fail("The vehicle is not heard any more; look at its power and its cable or radio.");
  case connection_phase::down:
    break;
  }
  return fail("The link to the vehicle is not open; look at the device or address that it is set to.");
}

} // namespace godwit::executor::preflight
