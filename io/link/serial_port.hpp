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
#include "io/link/stream_link.hpp"
#include "io/link/uri.hpp"

namespace godwit::io::link {

[[nodiscard]] tl::expected<descriptor, std::string> open_serial_port(const std::string& device, std::uint32_t baud);

// Throws away what the device has not put on the line yet: closing would wait for it, for up to half a minute.
void discard_serial_output(int port);

// serial:///dev/NAME:BAUD for stream_link. Opening takes no time to speak of and is done at once.
class serial_opener final : public stream_opener {
public:
  explicit serial_opener(const uri& where) : device_(where.device), baud_(where.baud) {}

  void open(std::function<void(result)> done) override;
  [[nodiscard]] ssize_t write(int stream, std::span<const std::byte> bytes) const override;
  void discard_output(int stream) const override;
  [[nodiscard]] std::string where() const override;
  [[nodiscard]] std::string why_it_ended(int error) const override;

private:
  std::string device_;
  std::uint32_t baud_;
};

} // namespace godwit::io::link
