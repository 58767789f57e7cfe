#include "tests/support/mqtt_peer.hpp"

#include <array>
#include <stdexcept>
#include <utility>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

namespace godwit::tests::mqtt {

std::optional<raw_packet> peer_end::read() {
  std::array<char, 4096> piece{};
  while (packets_.empty()) {
    const auto got = ::recv(socket_, piece.data(), piece.size(), 0);
    if (got <= 0)
      return std::nullopt;
    bytes_.append(piece.data(), static_cast<std::size_t>(got));
    packets_ = packets_in(bytes_);
  }
  auto result = std::move(packets_.front());
  packets_.erase(packets_.begin());
  return result;
}

bool peer_end::write(std::string_view bytes) const {
  while (!bytes.empty()) {
    const auto sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent <= 0)
      return false;
    bytes.remove_prefix(static_cast<std::size_t>(sent));
  }
  return true;
}

std::optional<raw_packet> peer_end::last() {
  std::optional<raw_packet> result;
  while (auto next = read())
    result = std::move(next);
  return result;
}

peer::peer(script what) : script_(std::move(what)) {
  listening_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  if (::bind(listening_, reinterpret_cast<sockaddr*>(&address), size) != 0 || ::listen(listening_, 16) != 0 ||
      ::getsockname(listening_, reinterpret_cast<sockaddr*>(&address), &size) != 0)
    throw std::runtime_error("no port is free");
  port_ = ntohs(address.sin_port);
  thread_ = std::thread([this] { run(); });
}

peer::~peer() {
  is_ending_ = true;
  ::shutdown(listening_, SHUT_RDWR);
  if (const int open = connection_; open >= 0)
    ::shutdown(open, SHUT_RDWR);
  thread_.join();
  ::close(listening_);
}

void peer::run() {
  while (!is_ending_) {
    const int accepted = ::accept(listening_, nullptr, nullptr);
    if (accepted < 0)
      continue;
    connection_ = accepted;
    if (!is_ending_) {
      peer_end end(accepted);
      script_(end, ++connections_);
    }
    connection_ = -1;
    ::close(accepted);
  }
}

} // namespace godwit::tests::mqtt
