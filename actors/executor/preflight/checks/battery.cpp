#include "actors/executor/preflight/checks/battery.hpp"

#include <string>

namespace godwit::executor::preflight {

result look_at_battery(const facts& seen, const settings& set) {
  if (!is_vehicle_heard(seen))
    return skipped("The vehicle is not heard: what is left in its battery is not known.");
  if (!seen.vehicle.battery_percent)
    return fail("Nothing was heard of the battery yet; wait until the vehicle reports its state.");
  const auto percent = *seen.vehicle.battery_percent;
  if (percent < 0 || percent > 100)
    return degraded("The vehicle does not know what is left in its battery, and so no failsafe will act on it; "
                    "look at the settings of its power monitor, or fly only as long as is certain.");
  const auto needed = set.battery_return_percent + set.battery_margin_percent;
  if (percent <= needed)
    return fail("The battery is at " + std::to_string(percent) + " %, and more than " + std::to_string(needed) +
                " % are needed to fly; put in a charged one.");
  return pass("The battery is at " + std::to_string(percent) + " %.");
}

} // namespace godwit::executor::preflight
