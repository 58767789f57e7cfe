// The address of a Unix socket by the path of its file. Thread: pure. Source: unix(7).
#pragma once

#include <cstring>
#include <string>

#include <sys/socket.h>
#include <sys/un.h>

#include <tl/expected.hpp>

namespace godwit::control {

[[nodiscard]] inline tl::expected<sockaddr_un, std::string> unix_address(const std::string& path) {
  sockaddr_un result{};
  result.sun_family = AF_UNIX;
  if (path.empty() || path.size() >= sizeof result.sun_path)
    return tl::make_unexpected("the path of the control socket, " + path + ", is " + std::to_string(path.size()) +
                               " bytes long; it may have 1 to " + std::to_string(sizeof result.sun_path - 1) +
                               ": name a shorter one with --control");
  std::memcpy(result.sun_path, path.data(), path.size());
  return result;
}

} // namespace godwit::control
