// What FILE_TRANSFER_PROTOCOL asks for: does it read, does it write, and is it about the files of plans?
//
// Written files can be parameters and plans (ArduPilot: @PARAM, @MISSION). An operation that is not known counts as
// writing. A write to an open file names no path: what has opened it was looked at. Thread: pure. Source: the MAVLink
// FTP service; FILE_TRANSFER_PROTOCOL (110); ArduPilot's AP_Filesystem.cpp.
#pragma once

#include <cstdint>
#include <vector>

#include "io/mavlink/frame.hpp"

namespace godwit::ground_port::passing {

enum class file_access {
  read,
  write,
  write_plan // whatever is armed or not: plans are godwit's
};

[[nodiscard]] file_access file_access_of(io::mavlink::byte_view payload);

// NAK, to TO: it was not done. The payload of the answer to the one with PAYLOAD.
[[nodiscard]] std::vector<std::uint8_t> file_refusal(io::mavlink::byte_view payload, io::mavlink::sender to);

} // namespace godwit::ground_port::passing
