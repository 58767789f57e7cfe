// The vehicle of a ground station's plan: its "firmwareType" and "vehicleType", and the profile that they mean. Thread:
// pure. Source: MAVLink's common.xml, MAV_AUTOPILOT and MAV_TYPE; QGroundControl writes one type for each class.
#pragma once

#include <cstdint>
#include <optional>

#include "messages/mission/vehicle_profile.hpp"

namespace godwit::mission {

struct plan_vehicle {
  std::int64_t autopilot = 0;
  std::int64_t type = 0;
};

inline constexpr std::int64_t ardupilot_firmware = 3;
inline constexpr std::int64_t px4_firmware = 12;

// Nothing for what the table does not know.
[[nodiscard]] std::optional<vehicle_profile> profile_of(const plan_vehicle& named);

[[nodiscard]] plan_vehicle plan_vehicle_of(vehicle_profile profile);

} // namespace godwit::mission
