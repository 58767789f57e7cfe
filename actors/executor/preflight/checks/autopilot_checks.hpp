// Fails unless the autopilot's own checks before arming pass. Degraded when it does not say whether they do. Skipped
// while the vehicle is not heard. Thread: pure. Source: MAV_SYS_STATUS_PREARM_CHECK of MAVLink's common.xml.
#pragma once

#include <cstdint>

#include "actors/executor/preflight/facts.hpp"
#include "actors/executor/preflight/result.hpp"
#include "actors/executor/preflight/settings.hpp"
#include "io/mavlink/messages/heartbeat.hpp"

namespace godwit::executor::preflight {

[[nodiscard]] result look_at_autopilot_checks(const facts& seen, const settings& set);

inline constexpr std::uint32_t prearm_check_bit = 0x1000'0000; // MAV_SYS_STATUS_PREARM_CHECK

// What SYS_STATUS says about them. ArduPilot has the bit in `present` and, when they pass, in `health`. PX4 1.17 has it
// in `health` alone, so that for PX4 no bit at all means that they fail; from anybody else it means nothing.
[[nodiscard]] own_checks own_checks_of(const io::mavlink::sys_status& told, io::mavlink::mav_autopilot autopilot);

} // namespace godwit::executor::preflight
