// Hands on what arrives on a UDP socket, out of the buffer of its thread.
//
// Errors: the owner is asked about each and says whether to read on. Thread: the link's own.
#pragma once

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include <boost/asio/ip/udp.hpp>
#include <sys/socket.h>

#include "io/link/liveness.hpp"

namespace godwit::io::link {

class datagram_reader {
public:
  using endpoint = boost::asio::ip::udp::endpoint;
  static constexpr int max_a_turn = 16; // then timers and others have their turn
  // What the system keeps while this process is stopped: also what a person did to the vehicle. Its own size is 256
  // small datagrams, 2.5 s of a PX4 on a fast line, and the newest are dropped. It gives less where net.core.rmem_max
  // is less.
  static constexpr int receive_buffer_bytes = 4 << 20;

  // FAILED: an error number; true: read on, false: the socket is closed.
  datagram_reader(boost::asio::ip::udp::socket& socket, std::span<std::byte> buffer,
                  std::function<void(const endpoint&, std::span<const std::byte>)> heard,
                  std::function<bool(int)> failed);

  // The socket is open and does not block.
  void start();
  // Before the socket is closed: nothing is handed on any more.
  void stop() { ++generation_; }

private:
  void wait();
  void read(std::uint64_t generation);

  boost::asio::ip::udp::socket& socket_;
  std::function<void(const endpoint&, std::span<const std::byte>)> heard_;
  std::function<bool(int)> failed_;
  std::span<std::byte> buffer_;
  std::uint64_t generation_ = 0; // of the socket: a wait that was over just before it was closed must not count
  liveness alive_;
};

// One datagram to the system, from any thread, without blocking.
//
// Asio's own sockets must not be shared between threads, so senders use the descriptor, under the lock of their link.
// Source: send(2).

// The error number, 0 for none. TO is null on a connected socket.
[[nodiscard]] inline int send_datagram(int descriptor, std::span<const std::byte> bytes, const sockaddr* to,
                                       socklen_t to_size) {
  for (;;) {
    if (::sendto(descriptor, bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL, to, to_size) >= 0)
      return 0;
    if (errno != EINTR)
      return errno;
  }
}

} // namespace godwit::io::link
