// What the port says about itself to stations that ask while they connect: versions, capabilities, parameters.
// Thread: pure. Source: AUTOPILOT_VERSION (148), PROTOCOL_VERSION (300), MAV_PROTOCOL_CAPABILITY.
#pragma once

#include <optional>
#include <vector>

#include "actors/ground_port/settings.hpp"
#include "actors/ground_port/vehicle_role/param_table.hpp"
#include "io/mavlink/messages/version.hpp"

namespace godwit::ground_port {

// The capabilities are the port's own: what the vehicle can do beyond them is not reached through this port. Versions
// are the vehicle's, once it has told them.
[[nodiscard]] mavlink::autopilot_version version_to_show(const std::optional<mavlink::autopilot_version>& vehicle);

[[nodiscard]] mavlink::protocol_version protocol_to_show();

// As floats: ArduPilot and PX4 send integers differently, and a station that guesses wrongly must still read these.
[[nodiscard]] std::vector<vehicle_role::param> params_to_show(mavlink::sender ourselves);

} // namespace godwit::ground_port
