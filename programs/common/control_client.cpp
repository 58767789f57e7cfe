#include "programs/common/control_client.hpp"

#include <array>
#include <cerrno>
#include <cstring>

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include "io/link/descriptor.hpp"

namespace godwit::control {

namespace {

using std::chrono::steady_clock;
using line_result = tl::expected<std::string, std::string>;

line_result read_line(int socket, const std::string& path) {
  const auto end = steady_clock::now() + patience;
  std::string result;
  std::array<char, 4096> piece{};
  while (result.size() <= max_answer_bytes) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - steady_clock::now());
    pollfd readable{socket, POLLIN, 0};
    if (left.count() <= 0 || ::poll(&readable, 1, static_cast<int>(left.count())) == 0)
      return tl::make_unexpected("the godwitd at " + path + " does not answer");
    const auto count = ::read(socket, piece.data(), piece.size());
    if (count < 0 && errno == EINTR)
      continue;
    if (count <= 0)
      return tl::make_unexpected("the godwitd at " + path + " ended before it answered");
    result.append(piece.data(), static_cast<std::size_t>(count));
    if (const auto length = result.find('\n'); length != std::string::npos)
      return result.substr(0, length);
  }
  return tl::make_unexpected("what listens at " + path + " sends more than an answer has");
}

} // namespace

tl::expected<nlohmann::json, std::string> ask_daemon(const std::string& path, const nlohmann::json& question) {
  const auto address = unix_address(path);
  if (!address)
    return tl::make_unexpected(address.error());
  const io::link::descriptor socket(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  if (::connect(socket.number(), reinterpret_cast<const sockaddr*>(&*address), sizeof *address) != 0)
    return tl::make_unexpected("no godwitd answers at " + path + " (" + std::strerror(errno) +
                               "): does it run, and is it the one with this journal? --control names its socket");
  const auto line = question.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) +
                    "\n"; // a line fits into the socket's buffer
  // Who is turned away is told why, and may find that out before the question is sent.
  const bool is_sent =
      ::send(socket.number(), line.data(), line.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(line.size());
  const auto answer = read_line(socket.number(), path);
  if (!answer)
    return tl::make_unexpected(is_sent ? answer.error() : "the godwitd at " + path + " ended before it was asked");
  auto document = nlohmann::json::parse(*answer, nullptr, false);
  if (!document.is_object())
    return tl::make_unexpected("what listens at " + path + " is no godwitd");
  return document;
}

} // namespace godwit::control
