#include "actors/executor/preflight/checks/planned_home.hpp"

#include <string>

#include "actors/domain/geo/distance_text.hpp"

namespace godwit::executor::preflight {

result look_at_planned_home(const facts& seen, const settings&) {
  const auto& now = seen.mission;
  if (now.document == nullptr || !now.document->planned_home)
    return skipped("No mission with a planned home is loaded.");
  if (!is_vehicle_heard(seen))
    return skipped("The vehicle is not heard: how far its home is from the planned one is not known.");
  if (!now.planned_home)
    return fail("The planned home of the mission was not compared with the vehicle's home yet; it is as soon as the "
                "vehicle reports where it is and where its home is.");
  const auto away = geo::distance_text(now.planned_home->away_m);
  if (now.planned_home->away_m < far_from_planned_home_m)
    return pass("The planned home of the mission is " + away + " from the vehicle's home.");
  return degraded("The planned home of the mission is " + away + ' ' +
                  std::string(geo::direction_text(now.planned_home->bearing_deg)) +
                  " of the vehicle's home. Nothing flies there: returns lead to the vehicle's home. Check that the "
                  "mission is for this place.");
}

} // namespace godwit::executor::preflight
