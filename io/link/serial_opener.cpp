#include "io/link/serial_opener.hpp"

#include <cerrno>

#include "io/link/reasons.hpp"
#include "io/link/serial_port.hpp"

namespace godwit::io::link {

void serial_opener::open(std::function<void(result)> done) { done(open_serial_port(device_, baud_)); }

ssize_t serial_opener::write(int stream, std::span<const std::byte> bytes) const {
  return ::write(stream, bytes.data(), bytes.size());
}

void serial_opener::discard_output(int stream) const { discard_serial_output(stream); }

std::string serial_opener::where() const { return device_ + " at " + std::to_string(baud_) + " baud"; }

// A line that is hung up reads as ended.
std::string serial_opener::why_it_ended(int error) const { return device_reason(device_, error == 0 ? EIO : error); }

} // namespace godwit::io::link
