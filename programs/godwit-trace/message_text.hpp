// A frame as one line for people: its name, and its fields as NAME=VALUE in the order of the message's table.
//
//   COMMAND_ACK          command=400(COMPONENT_ARM_DISARM) result=0(ACCEPTED) progress=0 ...
//   ESC_INFO             46 bytes: 00112233445566778899aabbccddeeff...
//
// Numbers of enums have their name after them where it is known; text is in quotes with everything escaped that a
// terminal could take for a command; bytes are hexadecimal. What godwit does not decode is shown by its first bytes.
// Secrets are never shown. Thread: pure.
#pragma once

#include <string>

#include "io/mavlink/frame.hpp"

namespace godwit::trace_tool {

void append_message_text(std::string& out, const io::mavlink::frame_view& frame);

} // namespace godwit::trace_tool
