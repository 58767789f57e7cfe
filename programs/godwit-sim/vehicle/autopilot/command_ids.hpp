// Commands that stations give and that are no item of a plan, so that io/mavlink has no name for them.
// Thread: constants. Source: MAV_CMD of MAVLink's common.xml.
#pragma once

#include <cstdint>

namespace godwit::sim {

inline constexpr std::uint16_t preflight_reboot_shutdown = 246; // param1: 1 the autopilot starts again
inline constexpr std::uint16_t get_home_position = 410;
inline constexpr std::uint16_t get_message_interval_command = 510; // param1: id of the message
inline constexpr std::uint16_t request_protocol_version_command = 519;
inline constexpr std::uint16_t request_autopilot_capabilities = 520;

} // namespace godwit::sim
