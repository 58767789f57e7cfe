#include "programs/godwitd/service_manager.hpp"

#include <cerrno>
#include <charconv>
#include <cstddef>
#include <cstdlib>
#include <cstring>

#include <sys/socket.h>
#include <unistd.h>

#include "io/fields/utf8.hpp"

namespace godwit::daemon {
namespace {

std::optional<std::int64_t> number_in(const char* variable) {
  const char* const text = std::getenv(variable);
  if (text == nullptr)
    return std::nullopt;
  std::int64_t result = 0;
  const auto* const end = text + std::strlen(text);
  const auto read = std::from_chars(text, end, result);
  return read.ec == std::errc{} && read.ptr == end ? std::optional(result) : std::nullopt;
}

std::optional<std::chrono::microseconds> watchdog_in_environment() {
  const auto period = number_in("WATCHDOG_USEC");
  if (!period || *period <= 0)
    return std::nullopt;
  if (std::getenv("WATCHDOG_PID") != nullptr && number_in("WATCHDOG_PID") != ::getpid())
    return std::nullopt; // another process is meant
  return std::chrono::microseconds(*period);
}

} // namespace

tl::expected<service_manager, std::string> service_manager::at(const std::string& socket,
                                                               std::optional<std::chrono::microseconds> watchdog) {
  service_manager result;
  const bool is_abstract = socket.starts_with('@');
  if ((!is_abstract && !socket.starts_with('/')) || socket.size() < 2 || socket.size() >= sizeof(sockaddr_un::sun_path))
    return tl::make_unexpected("NOTIFY_SOCKET is \"" + socket + "\", which is no path and no name with @ of up to " +
                               std::to_string(sizeof(sockaddr_un::sun_path) - 1) +
                               " bytes; the service manager hears nothing");
  result.address_.sun_family = AF_UNIX;
  std::memcpy(&result.address_.sun_path[0], socket.data(), socket.size());
  if (is_abstract)
    result.address_.sun_path[0] = '\0';
  result.address_size_ =
      static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + socket.size() + (is_abstract ? 0 : 1));
  result.socket_ = io::link::descriptor(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (!result.socket_.is_open())
    return tl::make_unexpected(std::string("no socket for the service manager: ") + std::strerror(errno));
  result.watchdog_ = watchdog;
  return result;
}

tl::expected<service_manager, std::string> service_manager::from_environment() {
  const char* const socket = std::getenv("NOTIFY_SOCKET");
  return socket == nullptr ? service_manager() : at(socket, watchdog_in_environment());
}

void service_manager::tell_status(std::string_view sentence) const {
  // Half a character of UTF-8 would cost the whole line.
  std::string line = "STATUS=" + std::string(sentence.substr(0, io::whole_characters(sentence, max_status)));
  for (char& each : line)
    if (each == '\n')
      each = ' ';
  send(line);
}

void service_manager::tell_reloading() const {
  const auto now = std::chrono::steady_clock::now().time_since_epoch(); // CLOCK_MONOTONIC, as it is asked for
  send("RELOADING=1\nMONOTONIC_USEC=" +
       std::to_string(std::chrono::duration_cast<std::chrono::microseconds>(now).count()));
}

void service_manager::send(std::string_view lines) const {
  if (socket_.is_open())
    (void)::sendto(socket_.number(), lines.data(), lines.size(), MSG_NOSIGNAL,
                   reinterpret_cast<const sockaddr*>(&address_), address_size_);
}

} // namespace godwit::daemon
