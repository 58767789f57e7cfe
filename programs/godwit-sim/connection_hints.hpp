// How to reach a simulated vehicle with the ground stations that people use. Thread: pure. Source: the manuals of
// QGroundControl, MAVProxy and MAVSDK.
#pragma once

#include <string>
#include <vector>

#include "io/link/uri.hpp"

namespace godwit::sim {

// A line for each, for the link WHERE of a vehicle, with its port as it is.
[[nodiscard]] std::vector<std::string> connection_hints(const io::link::uri& where);

} // namespace godwit::sim
