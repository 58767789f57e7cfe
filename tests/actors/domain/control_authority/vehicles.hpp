// The vehicles of these tests, and the last item of their plans.
#pragma once

#include <cstdint>

#include "actors/domain/flight_mode/flight_modes.hpp"

namespace godwit::flight::tests {

inline constexpr mode_owner copter{io::mavlink::mav_autopilot::ardupilotmega, vehicle_class::multirotor};
inline constexpr mode_owner px4{io::mavlink::mav_autopilot::px4, vehicle_class::multirotor};
inline constexpr std::uint16_t last_item = 6;

} // namespace godwit::flight::tests
