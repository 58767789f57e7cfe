#include "tests/io/link/far_ends.hpp"

#include <array>
#include <cerrno>
#include <cstdlib>
#include <system_error>

#include <arpa/inet.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>

#include "tests/io/link/watcher.hpp"

namespace godwit::io::link::testing {
namespace {

constexpr std::size_t longest_text = 64 * 1024;

int checked(int result, const char* what) {
  if (result < 0)
    throw std::system_error(errno, std::generic_category(), what);
  return result;
}

sockaddr_in loopback(std::uint16_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return address;
}

descriptor bound_socket(int type, std::uint16_t port) {
  descriptor made(checked(::socket(AF_INET, type | SOCK_CLOEXEC, 0), "socket"));
  // A test that goes away and comes back takes its own old port again.
  const int on = 1;
  if (type == SOCK_STREAM)
    checked(::setsockopt(made.number(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on), "setsockopt");
  const auto address = loopback(port);
  checked(::bind(made.number(), reinterpret_cast<const sockaddr*>(&address), sizeof address), "bind");
  return made;
}

std::uint16_t port_of_socket(const descriptor& socket) {
  sockaddr_in address{};
  socklen_t size = sizeof address;
  checked(::getsockname(socket.number(), reinterpret_cast<sockaddr*>(&address), &size), "getsockname");
  return ntohs(address.sin_port);
}

bool readable(const descriptor& from) {
  pollfd entry{from.number(), POLLIN, 0};
  return ::poll(&entry, 1, static_cast<int>(std::chrono::milliseconds(patience).count())) == 1;
}

std::string read_bytes(const descriptor& from, std::size_t bytes) {
  std::string all;
  std::array<char, 4096> buffer{};
  while (all.size() < bytes && readable(from)) {
    const auto size = ::read(from.number(), buffer.data(), std::min(buffer.size(), bytes - all.size()));
    if (size <= 0)
      break;
    all.append(buffer.data(), static_cast<std::size_t>(size));
  }
  return all;
}

void write_all(const descriptor& to, std::string_view text) {
  while (!text.empty())
    text.remove_prefix(
        static_cast<std::size_t>(checked(static_cast<int>(::write(to.number(), text.data(), text.size())), "write")));
}

} // namespace

udp_end::udp_end(std::uint16_t port) : socket_(bound_socket(SOCK_DGRAM, port)), port_(port_of_socket(socket_)) {}

void udp_end::send(std::uint16_t port, std::string_view text) const {
  const auto to = loopback(port);
  // The socket may hold the news that an earlier datagram met nobody; the second try sends.
  for (int n = 0; n < 2; ++n)
    if (::sendto(socket_.number(), text.data(), text.size(), 0, reinterpret_cast<const sockaddr*>(&to), sizeof to) >= 0)
      return;
  throw std::system_error(errno, std::generic_category(), "sendto");
}

std::optional<std::string> udp_end::receive() const {
  if (!readable(socket_))
    return std::nullopt;
  std::string text(longest_text, '\0');
  sockaddr_in from{};
  socklen_t size = sizeof from;
  const auto got = ::recvfrom(socket_.number(), text.data(), text.size(), 0, reinterpret_cast<sockaddr*>(&from), &size);
  if (got < 0)
    return std::nullopt;
  last_sender_ = ntohs(from.sin_port);
  text.resize(static_cast<std::size_t>(got));
  return text;
}

std::uint16_t unused_udp_port() { return udp_end().port(); }

serial_line::serial_line() {
  std::string pattern = (std::filesystem::temp_directory_path() / "godwit-link-XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr)
    throw std::system_error(errno, std::generic_category(), "mkdtemp");
  folder_ = pattern;
  path_ = folder_ / "ttyTest";
  plug_in();
}

serial_line::~serial_line() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

void serial_line::hang_up() { master_.reset(); }

void serial_line::unplug() {
  std::filesystem::remove(path_);
  hang_up();
}

void serial_line::plug_in() {
  master_ = descriptor(checked(::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC), "posix_openpt"));
  checked(::grantpt(master_.number()), "grantpt");
  checked(::unlockpt(master_.number()), "unlockpt");
  std::array<char, 128> name{};
  if (const int error = ::ptsname_r(master_.number(), name.data(), name.size()); error != 0)
    throw std::system_error(error, std::generic_category(), "ptsname_r");
  std::filesystem::remove(path_);
  std::filesystem::create_symlink(name.data(), path_);
}

void serial_line::write(std::string_view text) const { write_all(master_, text); }

std::string serial_line::read(std::size_t bytes) const { return read_bytes(master_, bytes); }

tcp_end::tcp_end(std::uint16_t port, int backlog)
    : listener_(bound_socket(SOCK_STREAM, port)), port_(port_of_socket(listener_)) {
  checked(::listen(listener_.number(), backlog), "listen");
}

void tcp_end::accept() {
  if (readable(listener_))
    connection_ = descriptor(checked(::accept4(listener_.number(), nullptr, nullptr, SOCK_CLOEXEC), "accept"));
}

void tcp_end::write(std::string_view text) const { write_all(connection_, text); }

std::string tcp_end::read(std::size_t bytes) const { return read_bytes(connection_, bytes); }

tcp_caller::tcp_caller(std::uint16_t port)
    : connection_(checked(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0), "socket")) {
  const auto to = loopback(port);
  checked(::connect(connection_.number(), reinterpret_cast<const sockaddr*>(&to), sizeof to), "connect");
}

void tcp_caller::write(std::string_view text) const { write_all(connection_, text); }

std::string tcp_caller::read(std::size_t bytes) const { return read_bytes(connection_, bytes); }

bool tcp_caller::has_bytes() const {
  pollfd entry{connection_.number(), POLLIN, 0};
  return ::poll(&entry, 1, 0) == 1;
}

bool tcp_caller::is_hung_up() const {
  char byte = 0;
  return readable(connection_) && ::read(connection_.number(), &byte, 1) <= 0;
}

} // namespace godwit::io::link::testing
