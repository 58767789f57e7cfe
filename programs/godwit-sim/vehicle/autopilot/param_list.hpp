// The parameters that each simulated autopilot shows: a believable choice with what ground stations ask for by name.
//
// A value that is set is kept and given back; none of them changes what the vehicle does, but for those that the
// autopilot reads (its header says which). Thread: pure.
#pragma once

#include <vector>

#include "actors/ground_port/vehicle_role/param_table.hpp"
#include "programs/godwit-sim/vehicle/autopilot/names.hpp"

namespace godwit::sim {

[[nodiscard]] std::vector<role::param> rover_params();
[[nodiscard]] std::vector<role::param> px4_params();
[[nodiscard]] std::vector<role::param> copter_params();
[[nodiscard]] std::vector<role::param> plane_params();

} // namespace godwit::sim
