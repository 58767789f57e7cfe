#include "io/link/serial_port.hpp"

#include <cerrno>

#include <asm/ioctls.h>
#include <asm/termbits.h> // instead of <termios.h>, which knows fixed rates only and must not come along
#include <fcntl.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>

#include "io/link/reasons.hpp"

namespace godwit::io::link {

namespace {

// The kernel's numbers for the ends of pseudo-terminals that programs open (UNIX98_PTY_SLAVE_MAJOR, 8 of them).
constexpr unsigned first_pty_major = 136;
constexpr unsigned last_pty_major = 143;
constexpr std::uint32_t worst_rate_error_percent = 3;

bool is_pseudo_terminal(int port) {
  struct stat info {};
  if (::fstat(port, &info) != 0)
    return false;
  const auto number = major(info.st_rdev);
  return number >= first_pty_major && number <= last_pty_major;
}

// Gives the error number, 0 for none.
int lock(int port) {
  if (::flock(port, LOCK_EX | LOCK_NB) != 0)
    return errno;
  if (!is_pseudo_terminal(port) && ::ioctl(port, TIOCEXCL) != 0)
    return errno;
  return 0;
}

termios2 raw(termios2 settings, std::uint32_t baud) {
  settings.c_iflag = 0;
  settings.c_oflag = 0;
  settings.c_lflag = 0;
  settings.c_cflag = CS8 | CREAD | CLOCAL | BOTHER | (BOTHER << IBSHIFT); // the rate of both directions is free
  settings.c_ispeed = baud;
  settings.c_ospeed = baud;
  settings.c_cc[VMIN] = 1; // with 0 a read of nothing could not be told from the end of the line
  settings.c_cc[VTIME] = 0;
  return settings;
}

bool is_near(std::uint64_t real, std::uint64_t wanted) {
  const auto off = real > wanted ? real - wanted : wanted - real;
  return off * 100 <= wanted * worst_rate_error_percent;
}

int set_up(int port, std::uint32_t baud, bool& rate_is_right) {
  termios2 settings{};
  if (::ioctl(port, TCGETS2, &settings) != 0)
    return errno;
  settings = raw(settings, baud);
  if (::ioctl(port, TCSETS2, &settings) != 0 || ::ioctl(port, TCGETS2, &settings) != 0)
    return errno;
  rate_is_right = is_near(settings.c_ospeed, baud);
  // What came before belongs to a line that was set up differently.
  return ::ioctl(port, TCFLSH, TCIFLUSH) != 0 ? errno : 0;
}

} // namespace

tl::expected<descriptor, std::string> open_serial_port(const std::string& device, std::uint32_t baud) {
  descriptor port(::open(device.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  if (!port.is_open())
    return tl::make_unexpected(device_reason(device, errno));
  if (::isatty(port.number()) == 0)
    return tl::make_unexpected(device_reason(device, errno));
  if (const int error = lock(port.number()); error != 0)
    return tl::make_unexpected(device_reason(device, error));
  bool rate_is_right = false;
  if (const int error = set_up(port.number(), baud, rate_is_right); error != 0)
    return tl::make_unexpected(device_reason(device, error));
  if (!rate_is_right)
    return tl::make_unexpected(device + ": the device can not do " + std::to_string(baud) +
                               " baud; usual rates are 57600, 115200, 230400, 460800, 500000, 921600 and 1500000");
  return port;
}

void discard_serial_output(int port) { static_cast<void>(::ioctl(port, TCFLSH, TCOFLUSH)); }

void serial_opener::open(std::function<void(result)> done) { done(open_serial_port(device_, baud_)); }

ssize_t serial_opener::write(int stream, std::span<const std::byte> bytes) const {
  return ::write(stream, bytes.data(), bytes.size());
}

void serial_opener::discard_output(int stream) const { discard_serial_output(stream); }

std::string serial_opener::where() const { return device_ + " at " + std::to_string(baud_) + " baud"; }

// A line that is hung up reads as ended.
std::string serial_opener::why_it_ended(int error) const { return device_reason(device_, error == 0 ? EIO : error); }

} // namespace godwit::io::link
