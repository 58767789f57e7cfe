// What to look at when nothing of use arrives on a MAVLink line: sentences for people. Thread: pure.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "io/link/uri.hpp"

namespace godwit::programs {

// Nothing arrived for SILENT. SENDS_HEARTBEAT: the other end was spoken to.
[[nodiscard]] std::string advice_for_silence(const io::link::uri& line, std::chrono::seconds silent,
                                             bool sends_heartbeat);
// BYTES arrived, and no frame.
[[nodiscard]] std::string advice_for_noise(const io::link::uri& line, std::uint64_t bytes);

inline constexpr const char* advice_for_mavlink_1 =
    "Switch the autopilot to MAVLink 2: ArduPilot by SERIALn_PROTOCOL = 2 for the port n, PX4 by MAV_PROTO_VER = 2; "
    "then restart it.";

} // namespace godwit::programs
