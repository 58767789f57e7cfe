// The other end of the control socket: one question to a running godwitd.
//
// Errors: a sentence: nobody listens, may not, or does not answer in time. Thread: the caller's; blocks.
#pragma once

#include <chrono>
#include <cstring>
#include <string>

#include <nlohmann/json.hpp>
#include <sys/socket.h>
#include <sys/un.h>
#include <tl/expected.hpp>

namespace godwit::control {

inline constexpr std::chrono::seconds patience{8}; // longer than the daemon's own time-out
inline constexpr std::size_t max_answer_bytes = 256 * 1024;

[[nodiscard]] tl::expected<nlohmann::json, std::string> ask_daemon(const std::string& path,
                                                                   const nlohmann::json& question);

// The address of a Unix socket by the path of its file. Thread: pure. Source: unix(7).
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
