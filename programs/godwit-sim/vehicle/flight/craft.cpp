#include "programs/godwit-sim/vehicle/flight/craft.hpp"

namespace godwit::sim {

craft rover_craft() { return {}; }

craft multirotor_craft() {
  return {.kind = craft_kind::multirotor, .speed_mps = 5, .acceleration_mps2 = 2, .turn_rate_deg_s = 90};
}

craft fixed_wing_craft() {
  return {.kind = craft_kind::fixed_wing,
          .speed_mps = 15,
          .acceleration_mps2 = 3,
          .climb_mps = 4,
          .descent_mps = 4,
          .min_speed_mps = 10,
          .max_bank_deg = 45,
          .loiter_radius_m = 60,
          .arrival_radius_m = 30,
          .takeoff_altitude_m = 50,
          .return_altitude_m = 60};
}

craft vtol_craft() {
  auto result = fixed_wing_craft();
  result.climb_mps = result.descent_mps = 2.5;
  result.has_rotors = true;
  return result;
}

pace own_pace(const craft& of) { return {of.speed_mps, of.climb_mps, of.descent_mps}; }

} // namespace godwit::sim
