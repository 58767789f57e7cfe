// A service manager's end of the notify socket, for tests. Thread: one owner.
#pragma once

#include <array>
#include <cstddef>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include <sys/socket.h>
#include <sys/un.h>

#include "io/link/descriptor.hpp"

namespace godwit::test {

class notify_listener {
public:
  // NAME: a path, or @ and a name.
  explicit notify_listener(const std::string& name) : socket_(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::memcpy(&address.sun_path[0], name.data(), name.size());
    const bool is_abstract = name.starts_with('@');
    if (is_abstract)
      address.sun_path[0] = '\0';
    const auto size = offsetof(sockaddr_un, sun_path) + name.size() + (is_abstract ? 0 : 1);
    if (::bind(socket_.number(), reinterpret_cast<const sockaddr*>(&address), static_cast<socklen_t>(size)) != 0)
      throw std::runtime_error("the notify socket can not be bound");
  }

  // What has come and was not taken.
  [[nodiscard]] std::vector<std::string> take_all() {
    std::vector<std::string> result;
    std::array<char, 4'096> buffer{};
    for (ssize_t size = 0; (size = ::recv(socket_.number(), buffer.data(), buffer.size(), MSG_DONTWAIT)) >= 0;)
      result.emplace_back(buffer.data(), static_cast<std::size_t>(size));
    return result;
  }

private:
  io::link::descriptor socket_;
};

} // namespace godwit::test
