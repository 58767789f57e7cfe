#include "programs/godwit-sim/vehicle/autopilot/home_item.hpp"

#include <cmath>

namespace godwit::sim {

mavlink::mission_item_int home_item(mavlink::mission_item_int kept, const position& home) {
  kept.x = static_cast<std::int32_t>(std::lround(home.latitude_deg * 1e7));
  kept.y = static_cast<std::int32_t>(std::lround(home.longitude_deg * 1e7));
  kept.z = static_cast<float>(home.altitude_m);
  return kept;
}

} // namespace godwit::sim
