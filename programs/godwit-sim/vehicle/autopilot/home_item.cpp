#include "programs/godwit-sim/vehicle/autopilot/home_item.hpp"

#include "programs/godwit-sim/vehicle/autopilot/telemetry.hpp"

namespace godwit::sim {

mavlink::mission_item_int home_item(mavlink::mission_item_int kept, const position& home) {
  kept.x = e7(home.latitude_deg);
  kept.y = e7(home.longitude_deg);
  kept.z = static_cast<float>(home.altitude_m);
  return kept;
}

} // namespace godwit::sim
