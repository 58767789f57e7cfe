// A frame as one JSON object on a line of its own (JSON Lines), for other programs.
//
//   {"time_us":1751373296123456,"system":1,"component":1,"sequence":7,"id":0,"name":"HEARTBEAT","signed":false,
//    "fields":{"type":2,...}}
//
// Time is microseconds since 1970, UTC. Numbers stand as they came, enums too; NaN and infinities are null. A message
// that godwit does not decode has "payload", its bytes as hexadecimal digits, in place of "fields". Secrets are left
// out. Thread: pure.
#pragma once

#include <cstdint>
#include <string>

#include "io/mavlink/frame.hpp"

namespace godwit::trace_tool {

// Without an end of line.
void append_message_json(std::string& out, std::uint64_t time_us, const io::mavlink::frame_view& frame);

} // namespace godwit::trace_tool
