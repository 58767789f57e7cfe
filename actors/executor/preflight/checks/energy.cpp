#include "actors/executor/preflight/checks/energy.hpp"

#include <string>

namespace godwit::executor::preflight {

result look_at_energy(const facts& seen, const settings& set) {
  if (!is_vehicle_heard(seen))
    return skipped("The vehicle is not heard: whether its battery lasts is not known.");
  if (!seen.mission.spare_percent)
    return skipped("How fast the battery drains is not known, so nobody has looked whether it lasts for the plan and "
                   "the way home; set flight.drain_percent_per_min.");
  const auto spare = *seen.mission.spare_percent;
  const bool is_critical = spare < set.battery_critical_percent - set.battery_return_percent;
  const auto reserve = std::to_string(set.battery_return_percent) + " % at which the failsafe returns";
  if (spare < 0 && set.starts_by_itself && !is_critical)
    return pass("By its drain the battery lasts for the plan, and the failsafe returns it on the way, at " +
                std::to_string(set.battery_return_percent) +
                " %: nobody is asked, because flights begin by themselves.");
  if (spare < 0)
    return degraded("By its drain the battery does not last for the plan and the way home above the " + reserve +
                    "; put in a charged one, or shorten the mission.");
  return pass("By its drain the battery lasts for the plan and the way home above the " + reserve + ".");
}

} // namespace godwit::executor::preflight
