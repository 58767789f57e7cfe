// The vehicles that drills fly.
#pragma once

#include <array>

#include "programs/godwit-sim/vehicle/personality.hpp"

namespace godwit::drill {

inline constexpr std::array every_vehicle{sim::personality::rover, sim::personality::px4, sim::personality::ardupilot,
                                          sim::personality::plane};

} // namespace godwit::drill
