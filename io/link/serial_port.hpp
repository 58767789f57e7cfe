// Opens a serial line the way MAVLink needs it: raw bytes, 8 data bits, no parity, 1 stop bit, no flow control.
//
// Any baud rate is asked for (BOTHER), and what the device has made of it is read back: a rate that is off by more than
// 3 % garbles bytes and is an error. The line is ours alone: an advisory lock keeps out programs that ask for one, and
// TIOCEXCL the others, except administrators'. On a pseudo-terminal TIOCEXCL is left out, because there the mark
// outlives the process that has set it, and would lock out its successor. Closing does not drop DTR, which resets some
// boards.
//
// Errors: a sentence for people. Blocks for no longer than the device takes to be set up. Thread: any.
// Source: termios(3), ioctl_tty(2), tcsetattr's TCSETS2 in Linux' asm/termbits.h, flock(2).
#pragma once

#include <cstdint>
#include <string>

#include <tl/expected.hpp>

#include "io/link/descriptor.hpp"

namespace godwit::io::link {

[[nodiscard]] tl::expected<descriptor, std::string> open_serial_port(const std::string& device, std::uint32_t baud);

// Throws away what the device has not put on the line yet: closing would wait for it, for up to half a minute.
void discard_serial_output(int port);

} // namespace godwit::io::link
