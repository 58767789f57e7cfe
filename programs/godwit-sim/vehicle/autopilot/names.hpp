// Short names for the libraries that a simulated autopilot is made of.
#pragma once

#include <cstdint>
#include <limits>

#include "io/time_units.hpp"

namespace godwit::io::mavlink {}
namespace godwit::ground_port::mission_server {}
namespace godwit::ground_port::vehicle_role {}

namespace godwit::sim {

namespace mavlink = io::mavlink;
namespace plans = ground_port::mission_server;
namespace role = ground_port::vehicle_role;

inline constexpr std::int64_t never_ns = std::numeric_limits<std::int64_t>::max();

} // namespace godwit::sim
