#include "programs/godwit-sim/vehicle/flight/craft.hpp"

namespace godwit::sim {

craft rover_craft() { return {}; }

craft multirotor_craft() {
  return {.kind = craft_kind::multirotor, .speed_mps = 5, .acceleration_mps2 = 2, .turn_rate_deg_s = 90};
}

pace own_pace(const craft& of) { return {of.speed_mps, of.climb_mps, of.descent_mps}; }

} // namespace godwit::sim
